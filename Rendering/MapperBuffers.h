// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MAPPERBUFFERS_H
#define DELAUNAYFLIP_MAPPERBUFFERS_H

#include "vtkNew.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <cstdint>
#include <functional>

namespace delaunayflip
{

/// A texture that tells when it is released. Its window does that before it goes.
class WatchedTexture : public vtkTextureObject
{
public:
  static WatchedTexture* New() { VTK_STANDARD_NEW_BODY(WatchedTexture); }
  vtkTypeMacro(WatchedTexture, vtkTextureObject);
  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->Superclass::ReleaseGraphicsResources(window);
    this->OnRelease(window);
  }
  std::function<void(vtkWindow*)> OnRelease = [](vtkWindow*) {};
};

/// Values of four bytes, which the shader reads as a texture.
struct ShaderBuffer
{
  vtkNew<vtkOpenGLBufferObject> Values;
  vtkNew<WatchedTexture> Texture;

  void MakeReadable(vtkOpenGLRenderWindow* window, std::int64_t count, unsigned int format)
  {
    this->Texture->SetContext(window);
    this->Texture->SetInternalFormat(format);
    this->Texture->CreateTextureBuffer(
      static_cast<unsigned int>(count), 1, VTK_FLOAT, this->Values);
  }

  void Activate(vtkShaderProgram* program, const char* name)
  {
    this->Texture->Activate();
    program->SetUniformi(name, this->Texture->GetTextureUnit());
  }

  void Release(vtkWindow* window)
  {
    this->Texture->ReleaseGraphicsResources(window);
    this->Values->ReleaseGraphicsResources();
  }
};

}

#endif
