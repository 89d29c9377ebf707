#pragma once
#include "geometry/high.h"
#include <mpi.h>
