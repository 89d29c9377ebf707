#pragma once
// A density by a function of the place.

#include <algorithm>
#include <functional>
#include <utility>

#include "scvt/density.h"

class FormulaDensity final : public pstripack::scvt::Density {
 public:
  using Function = std::function<double(const pstripack::Point&)>;
  explicit FormulaDensity(Function function) : function_(std::move(function)) {}
  using Density::at;
  void at(std::size_t n, const pstripack::Point* p, double* value) const override {
    std::transform(p, p + n, value, function_);
  }

 private:
  Function function_;
};
