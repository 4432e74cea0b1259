#version 330 core
// Positions are relative to the scene's origin; the matrix takes them to clip space.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 vertex_color;
uniform mat4 to_clip;
uniform vec4 viewer;      // place, 1; of a parallel view the direction towards him, 0
uniform vec2 pixel_depth; // what depth changes by over the size of a pixel where it is d:
                          // pixel_depth.x + d pixel_depth.y
uniform float set_back;   // by what a face recedes over so many pixels: see below
uniform vec4 planes[6];   // what is in front, normal . position + w > 0, can be left out
uniform int clipped_by;   // bit k: it is
flat out vec3 facing;
flat out vec4 color;
out float gl_ClipDistance[6];

// Edges lie on the faces that they bound: faces are moved away from the viewer by what they recede
// over the half width of a line, and by a little. Of thin triangles glPolygonOffset does not know
// how they recede; the normal does.
float depth_behind(vec4 at) {
  float facing_viewer = abs(dot(normal, normalize(viewer.xyz - viewer.w * position)));
  float c = clamp(facing_viewer, 0.1, 1.0);
  float recedes = sqrt(1.0 - c * c) / c;
  float per_pixel = abs(pixel_depth.x + at.z / at.w * pixel_depth.y);
  return set_back * (recedes * per_pixel + 4e-6) * at.w;
}

void main() {
  facing = normal;
  color = vertex_color;
  for (int k = 0; k < 6; ++k)
    gl_ClipDistance[k] = (clipped_by >> k & 1) != 0 ? -dot(planes[k], vec4(position, 1.0)) : 1.0;
  gl_Position = to_clip * vec4(position, 1.0);
  gl_Position.z += depth_behind(gl_Position);
}
