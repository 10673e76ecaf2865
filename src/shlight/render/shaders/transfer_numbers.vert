
// To transfer_sum.vert.

uniform highp isampler2DArray u_transfer;

vec4 fetch_transfer(ivec3 place) { return vec4(texelFetch(u_transfer, place, 0)); }
