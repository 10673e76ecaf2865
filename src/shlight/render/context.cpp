#include "shlight/render/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "shlight/core/error.h"

// Extensions used:
// [1] EGL_MESA_platform_surfaceless: a display that is no display. The default display fails without DISPLAY.
// [2] EGL_EXT_platform_device, EGL_EXT_device_enumeration: a display for each device, where the driver is not Mesa's.
// [3] EGL_KHR_surfaceless_context: a context that is current without a surface; everything is drawn into framebuffers.

namespace shlight {
namespace {

[[noreturn]] void throw_no_context(std::string_view reason) {
  throw Error("OpenGL", fmt::format("no context can be made without a window ({})", reason),
              "a driver of OpenGL ES 3.0 with EGL_MESA_platform_surfaceless or EGL_EXT_platform_device, such as Mesa's "
              "(Debian package libgl1-mesa-dri)");
}

// Displays that may do without a window, the most likely first. Extensions are asked for before their functions are
// called: libepoxy aborts on a function that the driver does not have.
std::vector<EGLDisplay> headless_displays() {
  std::vector<EGLDisplay> displays;
  const auto has = [](const char* extension) { return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension); };
  if (!has("EGL_EXT_platform_base")) return displays;
  if (has("EGL_MESA_platform_surfaceless"))
    displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  const bool has_devices = has("EGL_EXT_device_base") || has("EGL_EXT_device_enumeration");
  if (has("EGL_EXT_platform_device") && has_devices) {
    std::array<EGLDeviceEXT, 16> devices;
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count))
      for (EGLint i = 0; i < count; ++i)
        displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
  }
  return displays;
}

// A context of OpenGL ES 3.0 on `display`, made current; EGL_NO_CONTEXT where that fails, with the reason in `reason`.
EGLContext make_current_context(EGLDisplay display, std::string& reason) {
  const auto fail = [&reason](std::string_view step) {
    reason = fmt::format("{} failed with EGL error 0x{:x}", step, eglGetError());
    return EGL_NO_CONTEXT;
  };
  if (!eglInitialize(display, nullptr, nullptr)) return fail("eglInitialize");
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
    reason = "EGL_KHR_surfaceless_context is missing";
    return EGL_NO_CONTEXT;
  }
  if (!eglBindAPI(EGL_OPENGL_ES_API)) return fail("eglBindAPI");

  // The surface type 0 asks for no kind of surface at all.
  const EGLint config_attributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint num_configs = 0;
  if (!eglChooseConfig(display, config_attributes, &config, 1, &num_configs) || num_configs == 0)
    return fail("eglChooseConfig");
  const EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes);
  if (context == EGL_NO_CONTEXT) return fail("eglCreateContext");
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    fail("eglMakeCurrent");
    eglDestroyContext(display, context);
    return EGL_NO_CONTEXT;
  }
  return context;
}

}  // namespace

HeadlessContext::HeadlessContext() : display_(EGL_NO_DISPLAY), context_(EGL_NO_CONTEXT) {
  std::string reason = "EGL knows no display without a window";
  for (const EGLDisplay display : headless_displays()) {
    if (display == EGL_NO_DISPLAY) continue;
    context_ = make_current_context(display, reason);
    display_ = display;
    if (context_ != EGL_NO_CONTEXT) return;
  }
  throw_no_context(reason);
}

HeadlessContext::HeadlessContext(HeadlessContext&& other) noexcept
    : display_(other.display_), context_(std::exchange(other.context_, EGL_NO_CONTEXT)) {}

HeadlessContext::~HeadlessContext() {
  if (context_ == EGL_NO_CONTEXT) return;
  if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  // The display stays initialised: it belongs to the process, and other contexts may be alive on it.
}

std::string gl_renderer() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name ? name : "unknown";
}

}  // namespace shlight
