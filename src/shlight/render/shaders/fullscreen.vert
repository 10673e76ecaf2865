#version 300 es

// One triangle over the whole viewport, at the far plane (depth w, like every point at infinity). No attributes.

out highp vec2 v_ndc;  // in [-1, 1]

void main() {
  v_ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(v_ndc, 1.0, 1.0);
}
