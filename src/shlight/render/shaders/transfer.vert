#version 300 es
precision highp float;

// A mesh, instance by instance, lit by its transfer, in whatever way that is kept: what a vertex is lit with is a
// matter of the source that follows. Light and transfer are in the world's frame.

layout(location = 0) in vec3 a_position;
layout(location = 2) in vec2 a_texcoord;
layout(location = 3) in vec3 a_color;

uniform mat4 u_object_to_clip;
uniform int u_first_vertex;  // of the instance, among those of all instances

out vec3 v_radiance;
out vec2 v_texcoord;
out vec3 v_color;

// Vertices lie in textures row by row, a pixel for each.
const int kRow = 2048;

// Sum of L_i A_i of the vertex whose pixel that is.
vec3 vertex_radiance(ivec2 place);

void main() {
  int vertex = u_first_vertex + gl_VertexID;
  v_radiance = vertex_radiance(ivec2(vertex % kRow, vertex / kRow));
  v_texcoord = a_texcoord;
  v_color = a_color;
  gl_Position = u_object_to_clip * vec4(a_position, 1.0);
}
