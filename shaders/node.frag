#version 330 core
uniform vec4 color;
uniform float size;
flat in float opacity;
out vec4 pixel;

void main() {
  float radius = length(gl_PointCoord - 0.5) * (size + 1.0);
  float coverage = clamp(0.5 * size - radius + 0.5, 0.0, 1.0);
  pixel = vec4(color.rgb, color.a * opacity * coverage);
}
