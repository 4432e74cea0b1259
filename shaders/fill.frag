#version 330 core
uniform samplerBuffer triangle_colors;  // one colour per triangle
uniform int use_triangle_colors;
uniform int first_triangle;             // of the draw call, in the two tables
uniform int draw_surface;               // 0: nothing but the lines merged into it
uniform vec4 color;

// Lines too close together to be told apart are not drawn one by one: the surface takes on the
// colour that it has between them in the mean.
uniform int merge_lines;
uniform samplerBuffer triangle_lines;  // spacing, and length per area, in units of the mesh
uniform vec4 line_color;
uniform float line_width;       // pixels
uniform float pixels_per_unit;
uniform float merge_below;      // spacing in units of the mesh below which lines are merged whole;
                                // from twice that on they are not
uniform float fade_below;       // as in line.geom
uniform float vanishing_share;
out vec4 pixel;

float covered_by_lines() {
  vec2 lines = texelFetch(triangle_lines, first_triangle + gl_PrimitiveID).rg;
  if (lines.x >= 2.0 * merge_below) return 0.0;
  float share = lines.x * pixels_per_unit / fade_below;
  float opacity = clamp((share - vanishing_share) / (1.0 - vanishing_share), 0.0, 1.0);
  opacity *= clamp(2.0 - lines.x / merge_below, 0.0, 1.0);
  return 1.0 - exp(-opacity * line_color.a * line_width * lines.y / pixels_per_unit);
}

void main() {
  pixel = use_triangle_colors != 0 ? texelFetch(triangle_colors, first_triangle + gl_PrimitiveID) : color;
  if (merge_lines == 0) return;
  // The lines over the surface.
  float line = covered_by_lines() * pixel.a;
  float surface = draw_surface != 0 ? pixel.a * (1.0 - line) : 0.0;
  float alpha = line + surface;
  pixel = vec4((line_color.rgb * line + pixel.rgb * surface) / max(alpha, 1e-6), alpha);
}
