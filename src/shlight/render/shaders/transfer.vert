#version 300 es
precision highp float;
precision highp sampler2DArray;

// A mesh, instance by instance, lit by its transfer: the radiance of each vertex is the sum of L_i A_i. Light and
// transfer are in the world's frame.

layout(location = 0) in vec3 a_position;
layout(location = 2) in vec2 a_texcoord;
layout(location = 3) in vec3 a_color;

uniform mat4 u_object_to_clip;
uniform int u_first_vertex;  // of the instance, among those of all instances

// A pixel of a layer belongs to a vertex, row by row, and layer k has coefficients 4k ... 4k+3 of all vertices. Where
// transfer is coloured, the layers of green come after those of red, and those of blue last.
uniform sampler2DArray u_transfer;
uniform bool u_colored;
uniform int u_layers;        // of one channel
uniform mat3x4 u_light[64];  // L_4k ... L_4k+3, columns red, green and blue; room for 16 bands

out vec3 v_radiance;
out vec2 v_texcoord;
out vec3 v_color;

void main() {
  int vertex = u_first_vertex + gl_VertexID;
  int width = textureSize(u_transfer, 0).x;
  ivec2 place = ivec2(vertex % width, vertex / width);
  v_radiance = vec3(0.0);
  for (int k = 0; k < u_layers; ++k) {
    vec4 a = texelFetch(u_transfer, ivec3(place, k), 0);
    if (u_colored) {
      vec4 green = texelFetch(u_transfer, ivec3(place, u_layers + k), 0);
      vec4 blue = texelFetch(u_transfer, ivec3(place, 2 * u_layers + k), 0);
      v_radiance += vec3(dot(a, u_light[k][0]), dot(green, u_light[k][1]), dot(blue, u_light[k][2]));
    } else {
      v_radiance += a * u_light[k];
    }
  }
  v_texcoord = a_texcoord;
  v_color = a_color;
  gl_Position = u_object_to_clip * vec4(a_position, 1.0);
}
