// The tree of boxes is read as texels: the default device loads them several times as fast as structs from a storage
// buffer (docs/devices.md).
layout(set = 0, binding = 0, rgba32f) uniform readonly imageBuffer kept_in;

SelfBox box_at(int place) { return SelfBox(imageLoad(kept_in, 2 * place), imageLoad(kept_in, 2 * place + 1)); }
