#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in float spacing;
uniform mat4 to_clip;
uniform vec4 planes[6];  // as in space_fill.vert
uniform int clipped_by;
out Vertex {
  float spacing;
  float clip[6];
} vertex;

void main() {
  vertex.spacing = spacing;
  for (int k = 0; k < 6; ++k)
    vertex.clip[k] = (clipped_by >> k & 1) != 0 ? -dot(planes[k], vec4(position, 1.0)) : 1.0;
  gl_Position = to_clip * vec4(position, 1.0);
}
