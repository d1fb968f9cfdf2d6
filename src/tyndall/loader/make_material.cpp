// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/make_scene_parts.h"
#include "tyndall/loader/named_spectra.h"

namespace tyndall::loader {
namespace {

using MaterialTable = std::map<std::string, Material, std::less<>>;

struct MaterialContext {
  ParameterSet& parameters;
  const TextureTable& textures;
  const MaterialTable& named;
  const std::string& type;

  Rgb reflectance(std::string_view name, float otherwise) const {
    return textures.spectrum(parameters, name, SpectrumUse::reflectance)
        .value_or(Rgb(otherwise));
  }
};

struct Alpha {
  float x, y;
};

struct RoughnessNames {
  std::string_view both, u, v;
};

// pbrt-v4's relation; alphas below 1e-3 count as smooth there and here.
float alpha_of(float roughness, bool remaps) {
  const float alpha = remaps ? std::sqrt(roughness) : roughness;
  return alpha < 1e-3f ? 0 : alpha;
}

Alpha read_alpha(const MaterialContext& in,
                 RoughnessNames names = {"roughness", "uroughness", "vroughness"}) {
  ParameterSet& p = in.parameters;
  const float both = in.textures.number(p, names.both, 0, not_negative);
  const float u = in.textures.number(p, names.u, both, not_negative);
  const float v = in.textures.number(p, names.v, both, not_negative);
  const bool remaps = p.boolean("remaproughness", true);
  return {alpha_of(u, remaps), alpha_of(v, remaps)};
}

Material make_diffuse(const MaterialContext& in) {
  return DiffuseBsdf{in.reflectance("reflectance", 0.5f)};
}

// A metal that reflects `r` at normal incidence, by pbrt-v4's choice eta = 1.
ConductorBsdf metal_of_reflectance(Rgb r, Alpha alpha) {
  Rgb k;
  for (int i = 0; i < 3; ++i) {
    const float clamped = std::min(r[i], 0.9999f);
    k[i] = 2 * std::sqrt(clamped) / std::sqrt(1 - clamped);
  }
  return {Rgb(1), k, alpha.x, alpha.y};
}

Material make_metal(const MaterialContext& in, std::string_view eta_name,
                    std::string_view k_name, Alpha alpha) {
  ParameterSet& p = in.parameters;
  if (p.has("reflectance")) {
    if (p.has(eta_name) || p.has(k_name))
      p.error("reflectance",
              fmt::format("\"reflectance\" cannot be given together with \"{}\" or \"{}\"",
                          eta_name, k_name));
    p.ignore({eta_name, k_name});
    return metal_of_reflectance(in.reflectance("reflectance", 0.5f), alpha);
  }
  p.ignore({"reflectance"});
  const auto constant = [&](std::string_view name, std::string_view metal) {
    return in.textures.spectrum(p, name, SpectrumUse::coefficient)
        .value_or(*named_spectrum(metal));
  };
  return ConductorBsdf{constant(eta_name, "metal-Cu-eta"), constant(k_name, "metal-Cu-k"),
                       alpha.x, alpha.y};
}

Material make_conductor(const MaterialContext& in) {
  return make_metal(in, "eta", "k", read_alpha(in));
}

float read_index(const MaterialContext& in) {
  ParameterSet& p = in.parameters;
  const Rgb eta =
      in.textures.spectrum(p, "eta", SpectrumUse::coefficient).value_or(Rgb(1.5f));
  if (min_component(eta) > 0) return eta.g;
  p.error("eta",
          fmt::format("parameter \"eta\" must be positive, got {}", min_component(eta)));
  return 1.5f;
}

Material make_dielectric(const MaterialContext& in) {
  const float eta = read_index(in);
  const Alpha alpha = read_alpha(in);
  return DielectricBsdf{eta, alpha.x, alpha.y};
}

Material make_interface(const MaterialContext&) { return InterfaceBsdf{}; }

void say_instead(const MaterialContext& in, std::string_view replacement) {
  in.parameters.reporter().unsupported(
      in.parameters.where(),
      fmt::format("{}: materials of type \"{}\" are not supported yet; {} takes its place",
                  in.parameters.owner(), in.type, replacement));
}

Material make_thin_dielectric(const MaterialContext& in) {
  say_instead(in, "nothing (light passes)");
  in.parameters.ignore_all();
  return InterfaceBsdf{};
}

Material make_coated_diffuse(const MaterialContext& in) {
  say_instead(in, "\"diffuse\"");
  in.parameters.ignore({"roughness", "uroughness", "vroughness", "remaproughness",
                        "thickness", "eta", "g", "albedo", "maxdepth", "nsamples"});
  return make_diffuse(in);
}

Material make_coated_conductor(const MaterialContext& in) {
  say_instead(in, "\"conductor\"");
  in.parameters.ignore({"interface.roughness", "interface.uroughness",
                        "interface.vroughness", "interface.eta", "thickness", "g", "albedo",
                        "maxdepth", "nsamples"});
  const Alpha alpha = read_alpha(
      in, {"conductor.roughness", "conductor.uroughness", "conductor.vroughness"});
  return make_metal(in, "conductor.eta", "conductor.k", alpha);
}

Material make_diffuse_transmission(const MaterialContext& in) {
  say_instead(in, "\"diffuse\"");
  in.parameters.ignore({"transmittance"});
  const float scale = in.parameters.number("scale", 1, not_negative);
  Rgb reflectance = in.reflectance("reflectance", 0.25f) * scale;
  for (int i = 0; i < 3; ++i) reflectance[i] = std::min(reflectance[i], 1.0f);
  return DiffuseBsdf{reflectance};
}

Material make_subsurface(const MaterialContext& in) {
  say_instead(in, "\"diffuse\"");
  const Rgb reflectance = in.reflectance("reflectance", 0.5f);
  in.parameters.ignore_all();
  return DiffuseBsdf{reflectance};
}

Material make_dark(const MaterialContext& in) {
  say_instead(in, "a dark \"diffuse\"");
  in.parameters.ignore_all();
  return DiffuseBsdf{Rgb(0.1f)};
}

Material make_measured(const MaterialContext& in) {
  say_instead(in, "\"diffuse\"");
  in.parameters.ignore_all();
  return DiffuseBsdf{Rgb(0.5f)};
}

const Material* find_named(const MaterialContext& in, const std::string& name) {
  const auto found = in.named.find(name);
  if (found != in.named.end()) return &found->second;
  in.parameters.error("materials", fmt::format("there is no material named \"{}\"{}", name,
                                               did_you_mean(name, keys_of(in.named))));
  return nullptr;
}

// Of two diffuse materials the mean, otherwise the one with the larger share.
Material make_mix(const MaterialContext& in) {
  ParameterSet& p = in.parameters;
  const std::vector<std::string> names = p.strings("materials");
  const float amount = in.textures.number(p, "amount", 0.5f, {0, 1});
  if (names.size() != 2)
    fail(p.where("materials"),
         fmt::format("{}: parameter \"string materials\" must name 2 materials, got {}",
                     p.owner(), names.size()));
  const Material* a = find_named(in, names[0]);
  const Material* b = find_named(in, names[1]);
  if (!a || !b) return DiffuseBsdf{Rgb(0.5f)};
  const auto* diffuse_a = std::get_if<DiffuseBsdf>(a);
  const auto* diffuse_b = std::get_if<DiffuseBsdf>(b);
  if (diffuse_a && diffuse_b)
    return DiffuseBsdf{diffuse_a->reflectance * (1 - amount) +
                       diffuse_b->reflectance * amount};
  say_instead(in, "the material with the larger share");
  return amount < 0.5f ? *a : *b;
}

struct MaterialType {
  std::string_view name;
  Material (*make)(const MaterialContext&);
};

constexpr std::array material_types{
    MaterialType{"diffuse", make_diffuse},
    MaterialType{"conductor", make_conductor},
    MaterialType{"dielectric", make_dielectric},
    MaterialType{"interface", make_interface},
    MaterialType{"thindielectric", make_thin_dielectric},
    MaterialType{"coateddiffuse", make_coated_diffuse},
    MaterialType{"coatedconductor", make_coated_conductor},
    MaterialType{"diffusetransmission", make_diffuse_transmission},
    MaterialType{"subsurface", make_subsurface},
    MaterialType{"hair", make_dark},
    MaterialType{"measured", make_measured},
    MaterialType{"mix", make_mix},
    MaterialType{"", make_interface},
    MaterialType{"none", make_interface},
};

void ignore_bumps(ParameterSet& parameters) {
  for (const std::string_view name : {"displacement", "normalmap"})
    if (parameters.has(name))
      parameters.unsupported(
          name, fmt::format("\"{}\" is not supported yet, it is ignored", name));
  parameters.ignore({"displacement", "normalmap"});
}

}  // namespace

Material make_material(const std::string& type, ParameterSet& parameters,
                       const TextureTable& textures, const MaterialTable& named) {
  std::vector<std::string_view> names;
  for (const MaterialType& known : material_types) {
    if (known.name == type) {
      ignore_bumps(parameters);
      return known.make({parameters, textures, named, type});
    }
    if (!known.name.empty()) names.push_back(known.name);
  }
  parameters.fail_unknown_type("material", type, names);
}

}  // namespace tyndall::loader
