// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Windows of VTK without a display. Before 9.4 VTK of Debian draws through X alone, but its
/// generic window draws into any context that is current.
#include "EglWindow.h"

#include "OpenGLFunctions.h"
#include "TestWindow.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkGenericRenderWindowInteractor.h"
#include "vtkNew.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <vector>

namespace
{

struct Egl
{
  EGLDisplay Display = EGL_NO_DISPLAY;
  EGLSurface Surface = EGL_NO_SURFACE;
  EGLContext Context = EGL_NO_CONTEXT;
} TheEgl;

template <typename Function>
Function Find(const char* name)
{
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<EGLDeviceEXT> ListDevices()
{
  std::vector<EGLDeviceEXT> devices(32);
  EGLint count = 0;
  const auto query = Find<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (!query || !query(static_cast<EGLint>(devices.size()), devices.data(), &count))
  {
    count = 0;
  }
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

bool IsFirstOfCuda(EGLDeviceEXT device)
{
  constexpr EGLint cudaDevice = 0x323A; // EGL_CUDA_DEVICE_NV
  const auto query = Find<PFNEGLQUERYDEVICEATTRIBEXTPROC>("eglQueryDeviceAttribEXT");
  EGLAttrib number = -1;
  return query && query(device, cudaDevice, &number) && number == 0;
}

EGLDisplay OpenDisplay(bool allowsOthers)
{
  const auto get = Find<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  const std::vector<EGLDeviceEXT> devices = ListDevices();
  for (const bool anyDevice : { false, true })
  {
    for (EGLDeviceEXT device : devices)
    {
      if (get && (IsFirstOfCuda(device) || (anyDevice && allowsOthers)))
      {
        const EGLDisplay display = get(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        if (eglInitialize(display, nullptr, nullptr))
        {
          return display;
        }
      }
    }
  }
  return EGL_NO_DISPLAY;
}

void MakeContext()
{
  const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
    EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8, EGL_DEPTH_SIZE, 24,
    EGL_NONE };
  const EGLint size[] = { EGL_WIDTH, 1920, EGL_HEIGHT, 1080, EGL_NONE };
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(TheEgl.Display, wanted, &config, 1, &count);
  eglBindAPI(EGL_OPENGL_API);
  TheEgl.Surface = eglCreatePbufferSurface(TheEgl.Display, config, size);
  TheEgl.Context = eglCreateContext(TheEgl.Display, config, EGL_NO_CONTEXT, nullptr);
}

bool MakeCurrent()
{
  return eglMakeCurrent(TheEgl.Display, TheEgl.Surface, TheEgl.Surface, TheEgl.Context) == EGL_TRUE;
}

/// What the window asks of its owner.
void Answer(vtkObject*, unsigned long event, void*, void* data)
{
  switch (event)
  {
    case vtkCommand::WindowMakeCurrentEvent:
      MakeCurrent();
      break;
    case vtkCommand::WindowIsCurrentEvent:
      *static_cast<bool*>(data) = eglGetCurrentContext() == TheEgl.Context;
      break;
    default:
      *static_cast<int*>(data) = 1; // OpenGL is supported
  }
}

}

#ifdef GLEWAPIENTRY
/// Takes the place of GLEW's own. Debian's GLEW is built for X: it loads all functions of OpenGL,
/// and then reports that there is no display of X, which VTK takes for a failure.
extern "C" __attribute__((visibility("default"))) GLenum GLEWAPIENTRY glewInit()
{
  const auto own = reinterpret_cast<GLenum (*)()>(dlsym(RTLD_NEXT, "glewInit"));
  const GLenum code = own();
  return code == GLEW_ERROR_NO_GLX_DISPLAY ? GLEW_OK : code;
}
#endif

std::string OpenEgl(bool allowsOthers)
{
  TheEgl.Display = OpenDisplay(allowsOthers);
  if (TheEgl.Display == EGL_NO_DISPLAY)
  {
    return "EGL has no device" + std::string(allowsOthers ? "" : " of CUDA");
  }
  MakeContext();
  return MakeCurrent() ? "" : "EGL makes no context of OpenGL";
}

std::string GetRendererName()
{
  const GLubyte* name = glGetString(GL_RENDERER);
  return name ? reinterpret_cast<const char*>(name) : "unknown";
}

vtkSmartPointer<vtkRenderWindow> MakeTestWindow()
{
  auto window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
  vtkNew<vtkCallbackCommand> owner;
  owner->SetCallback(Answer);
  for (const unsigned long event : { vtkCommand::WindowMakeCurrentEvent,
         vtkCommand::WindowIsCurrentEvent, vtkCommand::WindowSupportsOpenGLEvent })
  {
    window->AddObserver(event, owner);
  }
#ifndef GLEWAPIENTRY
  window->SetOpenGLSymbolLoader(
    [](void*, const char* name) { return eglGetProcAddress(name); }, nullptr);
#endif
  window->SetReadyForRendering(true);
  return window;
}

vtkSmartPointer<vtkRenderWindowInteractor> MakeTestInteractor()
{
  return vtkSmartPointer<vtkGenericRenderWindowInteractor>::New();
}
