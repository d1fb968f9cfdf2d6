// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tyndall/guiding/gaussian_mixture.h"

namespace tyndall {

/// A mixture with a name, for parametrised tests.
struct NamedMixture {
  const char* name;
  std::vector<GaussianComponent> components;
};

/// Round and slanted, wide and narrow, in the middle, at an edge and at a corner.
inline std::vector<NamedMixture> example_mixtures() {
  const GaussianComponent middle{1, {0.5f, 0.4f}, {0.01f, 0, 0.01f}};
  const GaussianComponent slanted{2, {0.35f, 0.6f}, {0.02f, 0.0178f, 0.018f}};
  const GaussianComponent narrow{0.5f, {0.7f, 0.2f}, {4e-4f, -1e-4f, 3e-4f}};
  const GaussianComponent corner{0.3f, {0.02f, 0.98f}, {0.03f, -0.01f, 0.02f}};
  const GaussianComponent wide{1, {0.6f, 0.5f}, {0.3f, 0.1f, 0.2f}};
  std::vector<GaussianComponent> full{middle, slanted, narrow, corner, wide};
  full.push_back({0.4f, {0.9f, 0.5f}, {0.002f, 0, 0.02f}});
  full.push_back({0.6f, {0.2f, 0.2f}, {0.004f, 0.002f, 0.005f}});
  full.push_back({0.2f, {0.5f, 0.9f}, {0.01f, 0, 0.001f}});
  return {{"uniform", {}},      {"middle", {middle}}, {"slanted", {slanted}},
          {"corner", {corner}}, {"wide", {wide}},     {"narrow", {narrow, middle}},
          {"full", full}};
}

}  // namespace tyndall
