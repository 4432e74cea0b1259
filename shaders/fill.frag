#version 330 core
uniform samplerBuffer triangle_colors;  // one colour per triangle
uniform int use_triangle_colors;
uniform vec4 color;
out vec4 pixel;

void main() {
  pixel = use_triangle_colors != 0 ? texelFetch(triangle_colors, gl_PrimitiveID) : color;
}
