// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MapperShaders_h
#define MapperShaders_h

/// @file
/// How OpenGL draws triangles; the sizes of arrays are constants of vtkDelaunayFlipMapper.

namespace delaunayflip
{
/// Places are relative to the centre of the mesh, in units of half its diagonal.
constexpr const char* VertexShader = R"(//VTK::System::Dec
in vec3 place;
uniform mat4 placeToView;
uniform mat4 viewToClip;
out vec3 drawnPlace;
void main()
{
  drawnPlace = place;
  gl_Position = viewToClip * (placeToView * vec4(place, 1.0));
}
)";

/// A pixel's distance from an edge is the distance of its place from the line, divided by the
/// distance of places from pixel to pixel.
constexpr const char* FragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec3 drawnPlace;
uniform mat4 placeToView;
uniform samplerBuffer places;
uniform isamplerBuffer corners;
uniform isamplerBuffer counts;
uniform int colorBy;     // as in vtkDelaunayFlipMapper
uniform vec3 plainColor;
uniform vec3 bands[12];  // colours
uniform float bandsPerUnit;
uniform vec4 planes[6];  // 0: cuts nothing off
uniform vec2 light;      // ambient, diffuse
uniform vec3 edgeColor;
uniform float edgeWidth; // half of it, in pixels; 0: no edges

vec3 findPlace(int slot)
{
  int first = 3 * texelFetch(corners, 3 * gl_PrimitiveID + slot).r;
  return vec3(texelFetch(places, first).r, texelFetch(places, first + 1).r,
    texelFetch(places, first + 2).r);
}

// The smallest angle of a triangle has the largest cosine.
float findAngle(vec3 a, vec3 b, vec3 c)
{
  float area = length(cross(b - a, c - a));
  float most = max(dot(b - a, c - a), max(dot(c - b, a - b), dot(a - c, b - c)));
  return degrees(atan(area, most));
}

float findEdge(vec3 a, vec3 b, vec3 c, vec3 right, vec3 up)
{
  vec3 normal = cross(b - a, c - a);
  float area = length(normal);
  mat3 inward = mat3(cross(normal, b - a), cross(normal, c - b), cross(normal, a - c)) / area;
  vec3 along = vec3(
    dot(drawnPlace - a, inward[0]), dot(drawnPlace - b, inward[1]), dot(drawnPlace - c, inward[2]));
  vec3 perPixel = sqrt((right * inward) * (right * inward) + (up * inward) * (up * inward));
  vec3 pixels = along / perPixel;
  float inradius = area / (perPixel.x + perPixel.y + perPixel.z);
  float strength = min(1.0, inradius * inradius / (8.0 * edgeWidth));
  return strength * clamp(edgeWidth + 0.5 - min(pixels.x, min(pixels.y, pixels.z)), 0.0, 1.0);
}

void main()
{
  vec3 right = dFdx(drawnPlace);
  vec3 up = dFdy(drawnPlace);
  vec3 normal = cross(mat3(placeToView) * right, mat3(placeToView) * up);
  float size = length(normal);
  for (int i = 0; i < 6; ++i)
  {
    if (dot(planes[i], vec4(drawnPlace, 1.0)) < 0.0)
    {
      discard;
    }
  }
  vec3 a, b, c;
  if (colorBy == 1 || edgeWidth > 0.0)
  {
    a = findPlace(0);
    b = findPlace(1);
    c = findPlace(2);
  }
  vec3 color = plainColor;
  if (colorBy != 0)
  {
    float value = colorBy == 1 ? findAngle(a, b, c) : float(texelFetch(counts, gl_PrimitiveID).r);
    color = bands[int(clamp(value * bandsPerUnit, 0.0, 11.0))];
  }
  color *= light.x + light.y * (size > 0.0 ? abs(normal.z) / size : 1.0);
  if (edgeWidth > 0.0)
  {
    color = mix(color, edgeColor, findEdge(a, b, c, right, up));
  }
  gl_FragData[0] = vec4(color, 1.0);
}
)";
}

#endif
