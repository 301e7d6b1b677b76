// The tree of boxes is read as texels: the default device loads them several times as fast as structs from a storage
// buffer (docs/devices.md).
layout(set = 0, binding = 0, rgba32f) uniform readonly imageBuffer kept;

SelfBox box_at(int place) { return SelfBox(imageLoad(kept, 2 * place), imageLoad(kept, 2 * place + 1)); }
