// This file is empty: the library that it makes carries the precompiled headers of all rooms.
