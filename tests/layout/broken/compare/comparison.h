#pragma once
#include "tool.h"
