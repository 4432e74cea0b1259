#version 330 core
uniform vec4 light;     // towards it, of length 1
uniform float shading;  // 0: colours as they are
uniform float opacity;
uniform vec4 tint;      // towards this colour, as far as its alpha says
flat in vec3 facing;
flat in vec4 color;
out vec4 pixel;

void main() {
  float lit = 0.5 + 0.5 * abs(dot(facing, light.xyz));
  pixel = vec4(mix(color.rgb, tint.rgb, tint.a) * mix(1.0, lit, shading), color.a * opacity);
}
