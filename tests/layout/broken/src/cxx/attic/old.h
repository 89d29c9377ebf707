#pragma once
#include "geometry/high.h"
