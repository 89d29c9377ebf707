/* STRIPACK's CRLIST (17 arguments) from libngmath's CSCRLIST (16).
 *
 * CSCRLIST passes every circumcentre to CSSCOORDD with the addresses of RLATO(k) and RLONO(k), and does not
 * keep it. In our copy of its object that call leads to ngmath_keep_centre_, which stores the Cartesian
 * centre instead. With XC passed as RLATO and YC as RLONO, bits and time are those of STRIPACK, without
 * conversion to angles.
 */
#include <stddef.h>

void ngmath_crlist_(const int* n, const int* ncol, const double* x, const double* y, const double* z,
                    const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
                    double* rlato, double* rlono, double* rc, int* ier);

static _Thread_local const double* xc_of_call;
static _Thread_local double* zc_of_call;

void ngmath_keep_centre_(const double* px, const double* py, const double* pz, double* plat, double* plon,
                         double* pnrm) {
  const ptrdiff_t k = plat - xc_of_call;
  *plat = *px;
  *plon = *py;
  zc_of_call[k] = *pz;
  *pnrm = 1.0;
}

void crlist_(const int* n, const int* ncol, const double* x, const double* y, const double* z,
             const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
             double* xc, double* yc, double* zc, double* rc, int* ier) {
  xc_of_call = xc;
  zc_of_call = zc;
  ngmath_crlist_(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, rc, ier);
}
