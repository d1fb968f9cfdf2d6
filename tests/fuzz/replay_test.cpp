// SPDX-License-Identifier: Apache-2.0
// Each scene of the corpus gets exactly the messages that stand beside it in NAME.expected;
// a scene without that file loads in silence. TYNDALL_UPDATE_EXPECTED=1 writes the files
// anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "corpus.h"
#include "tyndall/loader/load_scene.h"

namespace tyndall {
namespace {

std::string messages_of(const std::string& path) {
  std::string text;
  try {
    for (const Diagnostic& warning : load_scene(path).warnings) text += warning.text + "\n";
  } catch (const std::runtime_error& error) {
    text = std::string(error.what()) + "\n";
  }
  return text;
}

std::string without(std::string text, const std::string& part) {
  for (size_t at = 0; (at = text.find(part, at)) != text.npos;) text.erase(at, part.size());
  return text;
}

TEST(CorpusTest, EachSceneGetsItsMessages) {
  const std::vector<std::filesystem::path> scenes = test::corpus(".scene");
  EXPECT_GE(scenes.size(), 40u);
  for (std::filesystem::path path : scenes) {
    const std::string messages =
        without(messages_of(path.string()), test::corpus_folder.string() + "/");
    const std::string name = path.filename().string();
    path.replace_extension(".expected");
    if (std::getenv("TYNDALL_UPDATE_EXPECTED") && !messages.empty())
      std::ofstream(path, std::ios::binary) << messages;
    EXPECT_EQ(messages, test::contents(path)) << name;
  }
}

}  // namespace
}  // namespace tyndall
