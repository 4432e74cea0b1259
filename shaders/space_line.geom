#version 330 core
// A line in space becomes a rectangle in pixels, as in line.geom, with the depths of its axis.
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;

uniform vec2 viewport;          // pixels
uniform float width;            // pixels
uniform float pixels_per_unit;  // where w is 1
uniform float fade_below;       // spacing in pixels below which lines fade
uniform float vanishing_share;  // of that spacing, where they are gone
in Vertex {
  float spacing;
  float clip[6];
} vertex[];

noperspective out vec2 along_across;  // pixels from the first end, and from the axis
flat out float line_length;
flat out float opacity;
out float gl_ClipDistance[6];

void main() {
  // What lies nearer than the nearest plane, behind the viewer perhaps, is cut off.
  vec4 p[2] = vec4[2](gl_in[0].gl_Position, gl_in[1].gl_Position);
  float near[2] = float[2](p[0].z + p[0].w, p[1].z + p[1].w);
  if (near[0] < 0.0 && near[1] < 0.0) return;
  float t[2] = float[2](0.0, 1.0);
  if (near[0] < 0.0) t[0] = near[0] / (near[0] - near[1]);
  if (near[1] < 0.0) t[1] = near[0] / (near[0] - near[1]);
  vec4 ends[2] = vec4[2](mix(p[0], p[1], t[0]), mix(p[0], p[1], t[1]));

  vec2 a = (ends[0].xy / ends[0].w * 0.5 + 0.5) * viewport;
  vec2 b = (ends[1].xy / ends[1].w * 0.5 + 0.5) * viewport;
  line_length = distance(a, b);
  vec2 along = line_length > 0.0 ? (b - a) / line_length : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);

  float drawn_width = max(width, 1.0);
  opacity = min(width, 1.0);
  if (vertex[0].spacing > 0.0) {
    float w = 0.5 * (ends[0].w + ends[1].w);
    float share = vertex[0].spacing * pixels_per_unit / (w * fade_below);
    opacity *= clamp((share - vanishing_share) / (1.0 - vanishing_share), 0.0, 1.0);
  }
  if (opacity < 0.004) return;
  vec2 reach = vec2(width + 2.0);
  if (any(lessThan(max(a, b), -reach)) || any(greaterThan(min(a, b), viewport + reach))) return;

  // Straight ends: where round ones overlap, a line of many pieces would have beads. Divided by w,
  // all is linear on screen.
  float rim = 0.5 * drawn_width + 1.0;
  for (int k = 0; k < 4; ++k) {
    int end = k / 2;
    float t_end = (end == 0) ? 0.0 : line_length;
    float side = (k % 2 == 0) ? -rim : rim;
    vec2 at = a + t_end * along + side * across;
    along_across = vec2(t_end, side);
    for (int c = 0; c < 6; ++c)
      gl_ClipDistance[c] = mix(vertex[0].clip[c], vertex[1].clip[c], t[end]) / ends[end].w;
    gl_Position = vec4(at / viewport * 2.0 - 1.0, ends[end].z / ends[end].w, 1.0);
    EmitVertex();
  }
  EndPrimitive();
}
