
// To transfer_sum.vert.

uniform highp sampler2DArray u_transfer;

vec4 fetch_transfer(ivec3 place) { return texelFetch(u_transfer, place, 0); }
