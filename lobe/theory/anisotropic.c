/* The anisotropic member of the family. With p = (h_x, h_y) / sqrt(1 + h_z), Lambert's azimuthal
 * projection, d omega is 2 dp and abs(p)^2 is 1 - h_z: the lobe is (1 - an ellipse's form)^m. */
#include <math.h>

#include "theory/internal.h"

double burnish_theory_anisotropic(int order, const double zeta[2], const double h[3]) {
    if (!(order >= 1 && zeta[0] > 0 && zeta[1] > 0)) {
        return NAN;
    }
    double u = 1 - (zeta[0] * h[0] * h[0] + zeta[1] * h[1] * h[1]) / (1 + h[2]);
    return u > 0 ? pow(u, order) : 0; /* NaN gives 0 */
}

void burnish_theory_anisotropic_sample(int order, const double zeta[2], const double xi[2],
                                       double direction[3]) {
    double radius = sqrt(1 - pow(xi[0], 1.0 / (order + 1))), azimuth = 2 * BURNISH_PI * xi[1];
    double x = radius * cos(azimuth) / sqrt(zeta[0]), y = radius * sin(azimuth) / sqrt(zeta[1]);
    double lambda = x * x + y * y, scale = sqrt(2 - lambda);
    direction[0] = x * scale;
    direction[1] = y * scale;
    direction[2] = 1 - lambda;
}
