#pragma once

#include <string>
#include <vector>

struct GLFWwindow;

namespace shlight::viewer {

// A window with an OpenGL ES 3.0 context, current on the thread that made it, and Dear ImGui in it. One at a time: both
// libraries keep their state to themselves.
class Window {
 public:
  // Sizes are in the units of the display; `scale` enlarges text and controls, 0 as the display wants it. Throws Error
  // where there is no display or no such context.
  Window(int width, int height, double scale);
  // The same Error where there is no display, before there is a window.
  static void require_display();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window();

  bool closed() const;
  // Takes in what has happened; waits for it, at most so many seconds.
  void poll(double wait_seconds);
  // Of what is drawn into; 0 where the window is minimised.
  int width() const;
  int height() const;
  // Of text and controls.
  double scale() const { return scale_; }
  void resize(int width, int height);
  void set_title(const std::string& title);
  // Paths dropped on the window since the last call.
  std::vector<std::string> take_dropped();
  void copy_to_clipboard(const std::string& text) const;
  // Whether anything has happened to the window or the pointer since the last call.
  bool take_events();

  // From any thread: poll() waits no longer.
  static void wake();

  // A second context, for one other thread to draw with: it shares textures, buffers and programs with the window's.
  void make_second_context_current() const;
  static void release_context();

  // Between these, the interface is described with ImGui; end_frame draws it. show() puts it on the screen.
  void begin_frame();
  void end_frame();
  void show();

  // A pointer that a script moves, in the place of the person's; button 0 to 2, or -1 for none.
  void point(float x, float y, int button);
  // Other windows have the person's attention now: what is held is let go, until it is pressed anew.
  void lose_focus();

 private:
  GLFWwindow* window_ = nullptr;
  GLFWwindow* hidden_ = nullptr;  // GLFW's contexts come with windows
  double scale_ = 1;
  std::vector<std::string> dropped_;
  bool events_ = true;
  bool pointed_ = false;
  float x_ = 0, y_ = 0;
  int button_ = -1;
  bool held_ = false;  // since before the window lost the focus
};

}  // namespace shlight::viewer
