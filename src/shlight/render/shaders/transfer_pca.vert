
// To transfer.vert: the radiance of a cluster's mean and weighted components, however many bands they have.

uniform highp isampler2DArray u_transfer;  // numbers 4k ... 4k+3 of all vertices in layer k: cluster, weights
uniform highp sampler2D u_rows;            // a row for each cluster: radiance of its mean and components, then zeros
uniform int u_layers;

vec3 vertex_radiance(ivec2 place) {
  vec4 weights = vec4(texelFetch(u_transfer, ivec3(place, 0), 0));
  int cluster = int(weights[0]);
  weights[0] = 1.0;  // of the mean
  vec3 radiance = vec3(0.0);
  for (int k = 0; k < u_layers; ++k) {
    if (k > 0) weights = vec4(texelFetch(u_transfer, ivec3(place, k), 0));
    for (int i = 0; i < 4; ++i) radiance += weights[i] * texelFetch(u_rows, ivec2(4 * k + i, cluster), 0).rgb;
  }
  return radiance;
}
