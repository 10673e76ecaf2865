
// To surface.frag: radiance as transfer.vert has it, interpolated between vertices.

in vec3 v_radiance;

vec3 white_radiance() { return v_radiance; }
