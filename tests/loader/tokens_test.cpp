// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "tyndall/integrators/nearest_name.h"
#include "tyndall/loader/excerpt.h"
#include "tyndall/loader/numbers.h"
#include "tyndall/loader/reporter.h"
#include "tyndall/loader/tokenizer.h"

namespace tyndall::loader {
namespace {

std::vector<std::string> texts(std::string_view scene) {
  Tokenizer tokenizer(0, scene);
  std::vector<std::string> result;
  for (Token t = tokenizer.next(); t.kind != TokenKind::end; t = tokenizer.next())
    result.emplace_back(t.text);
  return result;
}

TEST(TokenizerTest, CutsAtBlanksQuotesAndBrackets) {
  EXPECT_EQ(texts("Shape\t\"float x\"[1 .5]\r\n# all of this [\nEnd"),
            (std::vector<std::string>{"Shape", "float x", "[", "1", ".5", "]", "End"}));
}

// As in pbrt-v4, # begins a comment only where a token could begin.
TEST(TokenizerTest, KeepsHashesInsideWords) {
  EXPECT_EQ(texts("a#b #c\n\"d # e\""), (std::vector<std::string>{"a#b", "d # e"}));
}

TEST(TokenizerTest, EndsAtACommentWithoutNewline) {
  EXPECT_EQ(texts("a # b"), (std::vector<std::string>{"a"}));
}

TEST(TokenizerTest, RemembersPlaces) {
  Tokenizer tokenizer(3, " \"ab\" cd");
  const Token first = tokenizer.next();
  EXPECT_EQ(first.where.source, 3u);
  EXPECT_EQ(first.where.begin, 1u);
  EXPECT_EQ(first.where.end, 5u);
  EXPECT_EQ(tokenizer.peek().where.begin, 6u);
  EXPECT_EQ(tokenizer.next().where.begin, 6u);
  tokenizer.rewind(first);
  EXPECT_EQ(tokenizer.next().text, "ab");
}

TEST(TokenizerTest, ResolvesEscapes) {
  Tokenizer tokenizer(0, R"("a\"b\\c\n\t\'")");
  EXPECT_EQ(unescape(tokenizer.next()), "a\"b\\c\n\t'");
}

TEST(TokenizerTest, RefusesStringsThatGoOverTheLine) {
  Tokenizer tokenizer(0, "\"ab\ncd\"");
  EXPECT_THROW(tokenizer.next(), Failure);
  EXPECT_EQ(tokenizer.next().text, "cd");  // what follows can still be read
}

float float_of(std::string_view text) {
  float value = -1;
  EXPECT_EQ(parse_number(text, value), NumberError::none) << text;
  return value;
}

TEST(ParseNumberTest, ReadsDecimals) {
  EXPECT_EQ(float_of("7"), 7);
  EXPECT_EQ(float_of("-.5"), -0.5f);
  EXPECT_EQ(float_of("+5."), 5);
  EXPECT_EQ(float_of("1e-3"), 1e-3f);
  EXPECT_EQ(float_of("16777217"), 16777216);
  EXPECT_EQ(float_of("0.1"), 0.1f);
  EXPECT_EQ(float_of("1e-60"), 0);
  EXPECT_EQ(float_of("-1e-400"), 0);
  EXPECT_EQ(float_of("1e-40"), 1e-40f);
}

TEST(ParseNumberTest, RefusesWhatIsNoNumber) {
  for (const std::string_view text :
       {"", "-", "+", "nan", "-nan", "inf", "-inf", "infinity", "1x", "0x10", "+-1", "--1",
        "1 2", ".", "e5", "1e"}) {
    float number = 0;
    EXPECT_EQ(parse_number(text, number), NumberError::malformed) << text;
    int integer = 0;
    EXPECT_EQ(parse_number(text, integer), NumberError::malformed) << text;
  }
}

TEST(ParseNumberTest, RefusesWhatIsTooLarge) {
  float number = 0;
  int integer = 0;
  EXPECT_EQ(parse_number("1e39", number), NumberError::too_large);
  EXPECT_EQ(parse_number("-1e400", number), NumberError::too_large);
  EXPECT_EQ(parse_number("2147483648", integer), NumberError::too_large);
  EXPECT_EQ(parse_number("-2147483648", integer), NumberError::none);
  EXPECT_EQ(integer, std::numeric_limits<int>::min());
}

TEST(NearestNameTest, FindsMisspellings) {
  const std::vector<std::string_view> names{"radius", "zmin", "zmax", "filename"};
  EXPECT_EQ(did_you_mean("raduis", names), "; did you mean \"radius\"?");
  EXPECT_EQ(did_you_mean("Radius", names), "; did you mean \"radius\"?");
  EXPECT_EQ(did_you_mean("file", names), "; did you mean \"filename\"?");
  EXPECT_EQ(did_you_mean("color", names), "");
  EXPECT_EQ(did_you_mean("", names), "");
  EXPECT_EQ(did_you_mean(std::string(1000, 'r'), names), "");
}

TEST(ExcerptTest, PointsAtTheBytesMeant) {
  EXPECT_EQ(excerpt("Shape \"spheer\"", 12, 6, 8),
            "   12 | Shape \"spheer\"\n      |       ^~~~~~~~");
}

TEST(ExcerptTest, CountsColumnsByCharacter) {
  EXPECT_EQ(excerpt("\t\"\xC3\xA4\" x", 1, 6, 1),
            "    1 |  \"\xC3\xA4\" x\n      |      ^");
}

TEST(ExcerptTest, ShowsWhatCannotBePrintedAsQuestionMarks) {
  EXPECT_EQ(printable("a\x01\x7F\xFF\xC3z\xC3\xA4"), "a????z\xC3\xA4");
}

TEST(ExcerptTest, StaysWithinTheLine) {
  EXPECT_EQ(excerpt("ab", 1, 1, 1000), "    1 | ab\n      |  ^");
  EXPECT_EQ(excerpt("", 1, 0, 0), "    1 | \n      | ^");
}

TEST(ExcerptTest, CutsLongLinesAroundTheCaret) {
  const std::string text = excerpt(std::string(1000, 'x'), 1, 500, 2);
  EXPECT_EQ(text, "    1 | ..." + std::string(100, 'x') + "...\n      | " +
                      std::string(43, ' ') + "^~");
}

}  // namespace
}  // namespace tyndall::loader
