// SPDX-License-Identifier: Apache-2.0
// Renders one pixel through the installed library: exit status 0 if it is what it must be.
#include <tyndall/integrators/render.h>
#include <tyndall/loader/load_scene.h>

#include <cmath>
#include <cstdio>

int main() {
  tyndall::LoadedScene loaded = tyndall::parse_scene(
      "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
      "Sampler \"independent\" \"integer pixelsamples\" 4\n"
      "Camera \"perspective\"\n"
      "WorldBegin\n"
      "LightSource \"infinite\" \"rgb L\" [0.25 0.5 0.75]\n",
      "one_pixel.pbrt");
  const tyndall::Scene scene(std::move(loaded.scene));
  const tyndall::RenderResult result = tyndall::render(scene, loaded.settings);
  const tyndall::Rgb L = result.film.develop().rgb(0, 0);
  std::printf("%g %g %g\n", L.r, L.g, L.b);
  return std::abs(L.r - 0.25f) + std::abs(L.g - 0.5f) + std::abs(L.b - 0.75f) < 1e-5f ? 0
                                                                                      : 1;
}
