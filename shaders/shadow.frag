// Writes the depth from the light as a colour, because the raster pass reads the map as a storage image.
#version 460
layout(location = 0) out float depth;

void main() { depth = gl_FragCoord.z; }
