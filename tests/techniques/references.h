// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tyndall {

// The integrands of single and double scattering in double precision, by closed forms and
// quadrature that share nothing with the library.

/// [1/sr]
double henyey_greenstein(double g, double cos_theta);

/// The integral of henyey_greenstein(g, cos u) du over [0, alpha].
double arc(double g, double alpha);

/// The integral over phi in [0, phi] of henyey_greenstein(g, cos), cos the cosine of the
/// direction at polar angle theta and azimuth phi to one at polar angle alpha and azimuth
/// 0.
double azimuth_arc(double g, double alpha, double theta, double phi);

/// The integral over directions with polar angle up to theta about the light of the phase
/// function at a first vertex, seen at angle alpha from the light, times the light
/// scattered once along the direction: F(alpha) if theta is pi. The light is at distance
/// one.
double scattered_twice(double g, double alpha, double theta);

}  // namespace tyndall
