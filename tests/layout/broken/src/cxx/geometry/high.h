#pragma once
struct Grid {};
