// SPDX-License-Identifier: Apache-2.0
// Corrupts the corpus in thousands of ways, the same in every run, and asks only that
// loading ends with a scene or an exception of the right kind.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <stdexcept>
#include <string_view>

#include "corpus.h"
#include "tyndall/loader/load_scene.h"
#include "tyndall/loader/ply.h"

namespace tyndall {
namespace {

constexpr std::array<std::string_view, 24> fragments{"\"",
                                                     "[",
                                                     "]",
                                                     "#",
                                                     "\n",
                                                     "-1",
                                                     "0",
                                                     "1e38",
                                                     "nan",
                                                     "99999999999",
                                                     "\\",
                                                     "AttributeBegin ",
                                                     "AttributeEnd ",
                                                     "ObjectBegin \"a\" ",
                                                     "ObjectEnd ",
                                                     "WorldBegin ",
                                                     "Include \"good_part.scene\" ",
                                                     "Import \"includes_itself.scene\" ",
                                                     "Shape \"sphere\" ",
                                                     "\"float radius\" ",
                                                     "\"rgb L\" ",
                                                     "\"texture alpha\" ",
                                                     "\"integer indices\" ",
                                                     "Scale 1e20 1e20 1e20 "};

class Mutator {
 public:
  std::string mutate(std::string text) {
    for (size_t i = 1 + below(2); i > 0; --i) mutate_once(text);
    return text;
  }

 private:
  // The standard distributions differ between libraries; this does not.
  size_t below(size_t n) { return n == 0 ? 0 : random_() % n; }

  void mutate_once(std::string& text) {
    const size_t at = below(text.size() + 1);
    const size_t count = below(std::min<size_t>(text.size() - at, 40) + 1);
    switch (below(6)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, count);
        break;
      case 2:
        text.insert(below(text.size() + 1), text.substr(at, count));
        break;
      case 3:
        text.insert(at, fragments[below(fragments.size())]);
        break;
      case 4:
        text.resize(at);
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
    }
  }

  std::mt19937 random_{20160707};
};

TEST(MutationTest, ScenesNeverCrash) {
  Mutator mutator;
  size_t loaded = 0, refused = 0;
  const std::string name = (test::corpus_folder / "mutated.scene").string();
  for (const auto& path : test::corpus(".scene")) {
    const std::string original = test::contents(path);
    const int rounds = path.stem() == "good_world" ? 1500 : 60;
    for (int i = 0; i < rounds; ++i) {
      const std::string text = mutator.mutate(original);
      try {
        parse_scene(text, name);
        ++loaded;
      } catch (const SceneError& error) {
        EXPECT_FALSE(error.diagnostics().empty()) << text;
        ++refused;
      }
    }
  }
  EXPECT_GT(loaded, 10u);
  EXPECT_GT(refused, 2000u);
}

TEST(MutationTest, MeshesNeverCrash) {
  Mutator mutator;
  size_t loaded = 0, refused = 0;
  for (const auto& path : test::corpus(".ply")) {
    const std::string original = test::contents(path);
    for (int i = 0; i < 200; ++i) {
      try {
        loader::read_ply(mutator.mutate(original));
        ++loaded;
      } catch (const std::runtime_error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(loaded, 10u);
  EXPECT_GT(refused, 1000u);
}

}  // namespace
}  // namespace tyndall
