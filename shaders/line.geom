#version 330 core
// A line becomes a rectangle in pixels, one pixel wider than the line so that its rim can be
// smoothed; the fragment shader knows how far from the axis it is.
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;

uniform vec2 viewport;          // pixels
uniform float width;            // pixels
uniform float round_caps;       // 1: round ends, 0: straight ends
uniform float pixels_per_unit;
uniform float fade_below;       // spacing in pixels below which lines fade; 0: never
uniform float vanishing_share;  // of that spacing, where they are gone
uniform float merge_below;      // spacing in units of the mesh; see fill.frag; 0: no line is merged
uniform samplerBuffer line_spacing;
uniform int first_line;
uniform int use_line_opacity;
uniform samplerBuffer line_opacity;

noperspective out vec2 along_across;  // pixels from the first end, and from the axis
flat out float line_length;
flat out float opacity;

void main() {
  vec2 a = (gl_in[0].gl_Position.xy * 0.5 + 0.5) * viewport;
  vec2 b = (gl_in[1].gl_Position.xy * 0.5 + 0.5) * viewport;
  line_length = distance(a, b);
  vec2 along = line_length > 0.0 ? (b - a) / line_length : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);

  float drawn_width = max(width, 1.0);
  opacity = min(width, 1.0);
  if (fade_below > 0.0) {
    float spacing = texelFetch(line_spacing, first_line + gl_PrimitiveIDIn).r;
    float share = spacing * pixels_per_unit / fade_below;
    if (merge_below > 0.0) opacity *= clamp(spacing / merge_below - 1.0, 0.0, 1.0);
    opacity *= clamp((share - vanishing_share) / (1.0 - vanishing_share), 0.0, 1.0);
  }
  if (use_line_opacity != 0) opacity *= texelFetch(line_opacity, first_line + gl_PrimitiveIDIn).r;
  if (opacity < 0.004) return;
  // Outside on one side with both ends, rim included: the greater part of a mesh that is zoomed.
  vec2 reach = vec2(width + 2.0);
  if (any(lessThan(max(a, b), -reach)) || any(greaterThan(min(a, b), viewport + reach))) return;

  float rim = 0.5 * drawn_width + 1.0;
  float cap = round_caps * rim;
  for (int k = 0; k < 4; ++k) {
    float t = (k < 2) ? -cap : line_length + cap;
    float s = (k % 2 == 0) ? -rim : rim;
    vec2 p = a + t * along + s * across;
    along_across = vec2(t, s);
    float depth = gl_in[k / 2].gl_Position.z;
    gl_Position = vec4(p / viewport * 2.0 - 1.0, depth, 1.0);
    EmitVertex();
  }
  EndPrimitive();
}
