
// To transfer.vert: the sum over all coefficients.

// Layer k has coefficients 4k ... 4k+3 of all vertices. Where transfer is coloured, the layers of green come after
// those of red, and those of blue last.
uniform bool u_colored;
uniform int u_layers;        // of one channel
uniform mat3x4 u_light[64];  // L_4k ... L_4k+3, columns red, green and blue; room for 16 bands

// Four coefficients as they are kept: floats, or whole numbers, whose scales are in u_light.
vec4 fetch_transfer(ivec3 place);

vec3 vertex_radiance(ivec2 place) {
  vec3 radiance = vec3(0.0);
  for (int k = 0; k < u_layers; ++k) {
    vec4 a = fetch_transfer(ivec3(place, k));
    if (u_colored) {
      vec4 green = fetch_transfer(ivec3(place, u_layers + k));
      vec4 blue = fetch_transfer(ivec3(place, 2 * u_layers + k));
      radiance += vec3(dot(a, u_light[k][0]), dot(green, u_light[k][1]), dot(blue, u_light[k][2]));
    } else {
      radiance += a * u_light[k];
    }
  }
  return radiance;
}
