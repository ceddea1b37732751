// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/offscreen_window.h"

#include <vtkRenderWindow.h>

#ifdef __linux__
#include <vtk_glew.h>
// EGL after GLEW: both declare OpenGL types.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>
#endif

#include <mutex>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "widgets/view3d/prepare.h"

namespace spindrift::gui {

#ifdef __linux__
namespace {

constexpr GLenum glew_no_glx_display = 4;

/// A new context on the display that all share. Any thread.
std::pair<EGLDisplay, EGLContext> makeContext() {
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
      throw std::runtime_error("no OpenGL: EGL has no display. Install Mesa (Debian package libgl1-mesa-dri).");
    }
  }
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wanted, &config, 1, &count) == EGL_FALSE || count < 1) {
    throw std::runtime_error("no OpenGL: EGL offers no configuration for OpenGL 3.2.");
  }
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) throw std::runtime_error("no OpenGL: a context of version 3.2 was refused.");
  return {display, context};
}

class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow) OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  void createContext() {
    std::tie(display_, context_) = makeContext();
    this->SetOwnContext(1);
    this->SetReadyForRendering(true);
    this->SetFrameBlitModeToNoBlit();
    this->SetIsDirect(1);
    this->SetSupportsOpenGL(1);
    this->SetMapped(1);
  }

  void MakeCurrent() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_); }
  bool IsCurrent() override { return context_ != EGL_NO_CONTEXT && eglGetCurrentContext() == context_; }
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 1; }

  void OpenGLInitContext() override {
    if (this->Initialized) return;
    this->MakeCurrent();
    glewExperimental = GL_TRUE;
    const GLenum result = glewInit();
    this->GlewInitValid = result == GLEW_OK || result == glew_no_glx_display;
    if (!this->GlewInitValid)
      throw std::runtime_error("no OpenGL: its functions could not be loaded (GLEW status " + std::to_string(result) +
                               ").");
    this->Initialized = true;
    this->GetState()->Initialize(this);
  }

 protected:
  OffscreenWindow() = default;
  ~OffscreenWindow() override {
    if (context_ == EGL_NO_CONTEXT) return;
    MakeCurrent();
    this->Finalize();
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    context_ = EGL_NO_CONTEXT;
    // The display is shared by all views and stays until the program ends.
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

vtkStandardNewMacro(OffscreenWindow);

}  // namespace

vtkSmartPointer<vtkRenderWindow> makeOffscreenWindow() {
  auto window = vtkSmartPointer<OffscreenWindow>::New();
  window->createContext();
  return window;
}

void prepareOpenGl() {
  static std::once_flag once;
  std::call_once(once, [] {
    try {
      const auto [display, context] = makeContext();
      eglDestroyContext(display, context);
    } catch (const std::runtime_error&) {
      // The first view says what is missing.
    }
  });
}

#else

vtkSmartPointer<vtkRenderWindow> makeOffscreenWindow() {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  return window;
}

void prepareOpenGl() {}

#endif

}  // namespace spindrift::gui
