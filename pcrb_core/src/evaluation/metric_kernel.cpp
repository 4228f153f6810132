#include "evaluation/metric_kernel.hpp"

#include "arithmetic.hpp"

namespace pcrb {

PCRB_CLONES
double sumOfNorms(const PointArrays& points, const double* weights,
                  const Displacement& displacement) {
  return sumOfNormsBody(points, weights, displacement);
}

}  // namespace pcrb
