// An empty shader: a shadow map stores only the depth, which the rasteriser writes.
void main() {}
