#include "window.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "shlight/core/error.h"
#include "shlight/render/targets.h"
#include "theme.h"

namespace shlight::viewer {
namespace {

[[noreturn]] void throw_no_window() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  const std::string why = reason ? reason : "no reason given";
  glfwTerminate();
  throw Error("window", "cannot be opened (" + why + ")",
              "a display with OpenGL ES 3.0; without one, shlight render draws the same pictures into files");
}

// EGL is what OpenGL ES comes with; some drivers offer it through the display's own interface only.
GLFWwindow* open_window(int width, int height) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  for (const int api : {GLFW_EGL_CONTEXT_API, GLFW_NATIVE_CONTEXT_API}) {
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
    if (GLFWwindow* window = glfwCreateWindow(width, height, "shlight", nullptr, nullptr)) return window;
  }
  return nullptr;
}

Window* of(GLFWwindow* window) {
  return static_cast<Window*>(glfwGetWindowUserPointer(window));
}

}  // namespace

void Window::require_display() {
  if (!glfwInit()) throw_no_window();
}

Window::Window(int width, int height, double scale) {
  require_display();
  window_ = open_window(width, height);
  if (!window_) throw_no_window();
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  hidden_ = glfwCreateWindow(1, 1, "shlight", nullptr, window_);
  if (!hidden_) throw_no_window();
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    of(window)->dropped_.insert(of(window)->dropped_.end(), paths, paths + count);
    of(window)->events_ = true;
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double, double) { of(window)->events_ = true; });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { of(window)->events_ = true; });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { of(window)->events_ = true; });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int, int, int) { of(window)->events_ = true; });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double) { of(window)->events_ = true; });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int, int, int, int) { of(window)->events_ = true; });

  glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int focused) {
    if (!focused) of(window)->lose_focus();
  });

  float scale_x = 1, scale_y = 1;
  glfwGetWindowContentScale(window_, &scale_x, &scale_y);
  scale_ = scale > 0 ? scale : std::clamp(static_cast<double>(std::max(scale_x, scale_y)), 0.5, 4.0);

  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // panels have their places
  apply_theme(scale_);
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // calls the callbacks set above, too
  ImGui_ImplOpenGL3_Init("#version 300 es");
  ImGui_ImplOpenGL3_CreateDeviceObjects();  // else the first frame does, and is a long one
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(hidden_);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::closed() const {
  return glfwWindowShouldClose(window_) != 0;
}

void Window::poll(double wait_seconds) {
  if (wait_seconds > 0)
    glfwWaitEventsTimeout(wait_seconds);
  else
    glfwPollEvents();
}

int Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return width;
}

int Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return height;
}

void Window::resize(int width, int height) {
  glfwSetWindowSize(window_, width, height);
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

std::vector<std::string> Window::take_dropped() {
  return std::exchange(dropped_, {});
}

void Window::copy_to_clipboard(const std::string& text) const {
  glfwSetClipboardString(window_, text.c_str());
}

bool Window::take_events() {
  return std::exchange(events_, false);
}

void Window::point(float x, float y, int button) {
  pointed_ = true;
  x_ = x, y_ = y, button_ = button;
}

void Window::lose_focus() {
  held_ = true;
  events_ = true;
}

void Window::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  // The framebuffer's pixels are the interface's unit: text and controls are scaled by themselves.
  io.DisplaySize = {static_cast<float>(width()), static_cast<float>(height())};
  const float ratio = io.DisplayFramebufferScale.x > 0 ? io.DisplayFramebufferScale.x : 1;
  io.DisplayFramebufferScale = {1, 1};
  io.MousePos = {io.MousePos.x * ratio, io.MousePos.y * ratio};
  if (pointed_) {
    io.MousePos = {x_, y_};
    for (int i = 0; i < 3; ++i) io.MouseDown[i] = i == button_;
  }
  held_ = held_ && std::ranges::any_of(io.MouseDown, [](bool down) { return down; });
  if (held_) std::ranges::fill(io.MouseDown, false);
  ImGui::NewFrame();
}

void Window::end_frame() {
  ImGui::Render();
  constexpr double kPage = 0.07;
  WindowTarget::begin(width(), height(), kPage);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  // The package is compiled for desktop OpenGL, and asks for what OpenGL ES does not have (GL_POLYGON_MODE).
  WindowTarget::forget_errors();
}

void Window::show() {
  glfwSwapBuffers(window_);
}

void Window::wake() {
  glfwPostEmptyEvent();
}

void Window::make_second_context_current() const {
  glfwMakeContextCurrent(hidden_);
}

void Window::release_context() {
  glfwMakeContextCurrent(nullptr);
}

}  // namespace shlight::viewer
