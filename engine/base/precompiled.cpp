// Nothing: the library that this file makes carries the precompiled headers of all rooms.
