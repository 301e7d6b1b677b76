#include "drape.h"
