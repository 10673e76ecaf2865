#pragma once

#include <string>

namespace shlight {

// An OpenGL ES 3.0 context without a window or display, current on the thread that made it until it is destroyed there.
// Renderers do not know of it: they draw with whatever context is current, a window's or a browser's as well.
class HeadlessContext {
 public:
  // Throws Error where no driver offers such a context.
  HeadlessContext();
  HeadlessContext(HeadlessContext&& other) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) = delete;
  ~HeadlessContext();

 private:
  void* display_;  // EGLDisplay
  void* context_;  // EGLContext
};

// The driver's name of what draws in the current context, for instance "llvmpipe (LLVM 15.0.6, 256 bits)".
std::string gl_renderer();

}  // namespace shlight
