#pragma once
struct Grid;  // declared only
