#include "comparison.h"
