// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "apps/tyndall/commands.h"
#include "apps/tyndall/image_conversion.h"
#include "apps/tyndall/write_outputs.h"
#include "tyndall/image/io.h"

namespace tyndall::app {

namespace {

struct ConvertArguments {
  std::string input, output;
  std::optional<std::string> layer;
  std::optional<CropWindow> crop;
  float exposure = 0;
  std::optional<std::string> reference;
  std::optional<ErrorKind> error;
  std::optional<std::string> split;
  bool false_color = false;
  std::optional<ValueRange> range;
  WriteOptions write{.threads = 0};
};

ValueRange parse_range(const std::string& text) {
  const size_t comma = text.find(',');
  const std::string expected = "must be LOW,HIGH with LOW below HIGH, got '" + text + "'";
  if (comma == std::string::npos) throw std::invalid_argument(expected);
  const ValueRange range{parse_number<float>(text.substr(0, comma)),
                         parse_number<float>(text.substr(comma + 1))};
  if (!(range.low < range.high)) throw std::invalid_argument(expected);
  return range;
}

void check_arguments(const ConvertArguments& arguments) {
  if (arguments.error && !arguments.reference)
    throw UsageError("--error needs --reference");
  if (arguments.reference && !arguments.error)
    throw UsageError("--reference needs --error");
  if (arguments.error && arguments.split)
    throw UsageError("--error and --split exclude each other");
  if (arguments.range && !arguments.false_color)
    throw UsageError("--range needs --false-color");
}

/// The part of an input that the arguments ask for; faults carry the file's name.
Image read_part(const std::string& path, const ConvertArguments& arguments) {
  Image image = read_image(path);
  try {
    if (arguments.layer) image = select_layer(image, *arguments.layer);
    if (arguments.crop) image = crop_image(image, *arguments.crop);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
  }
  return expose_image(std::move(image), arguments.exposure);
}

ExitCode run_convert_command(const ConvertArguments& arguments) {
  check_arguments(arguments);
  check_outputs({arguments.output});
  Image image = read_part(arguments.input, arguments);
  try {
    if (arguments.error) {
      image =
          error_image(image, read_part(*arguments.reference, arguments), *arguments.error);
    }
    if (arguments.split) image = split_image(image, read_part(*arguments.split, arguments));
    if (arguments.false_color) {
      std::optional<ValueRange> range = arguments.range;
      if (!image.has_rgb())
        throw std::invalid_argument("the image has no R, G and B channels");
      image = to_false_color(image, range);
      fmt::print("false color from {:g} (black) to {:g} (pale yellow)\n", range->low,
                 range->high);
    }
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", arguments.input, error.what()));
  }
  write_outputs(image, {arguments.output}, arguments.write);
  return ExitCode::done;
}

void declare_arguments(Command& command, ConvertArguments& a) {
  command
      .positional("INPUT", &a.input, "an EXR, PNG, PFM or HDR file",
                  {.value = "", .required = true})
      .positional("OUTPUT", &a.output,
                  "its extension chooses the format: .exr, .hdr, .pfm, .png",
                  {.value = "", .required = true})
      .option("--layer", &a.layer,
              "take this layer as the colour: albedo, normal, depth, ...",
              {.value = "NAME"})
      .option("--crop",
              ArgumentParser([&a](const std::string& s) { a.crop = parse_crop(s); }),
              "a part, in pixels or as fractions", {.value = "X0,Y0,X1,Y1"})
      .option("--exposure", &a.exposure, "multiply by 2 to this power [0]",
              {.value = "STOPS"})
      .option("--tone", ArgumentParser([&a](const std::string& s) {
                a.write.tone.curve = s == "filmic" ? ToneCurve::filmic : ToneCurve::plain;
              }),
              "curve of PNG files [plain]", {.choices = {"plain", "filmic"}})
      .flag("--dither", &a.write.tone.dither, "PNG: no bands in smooth gradients")
      .flag("--half", &a.write.half, "EXR: 16 bits per channel")
      .option("--reference", &a.reference, "show the error against this image",
              {.value = "FILE"})
      .option("--error",
              ArgumentParser([&a](const std::string& s) { a.error = parse_error_kind(s); }),
              "which error",
              {.choices = {"difference", "absolute", "relative", "flip", "hdr-flip"}})
      .option("--split", &a.split, "take the right half from this image", {.value = "FILE"})
      .flag("--false-color", &a.false_color, "show the channels' mean in false color")
      .option("--range",
              ArgumentParser([&a](const std::string& s) { a.range = parse_range(s); }),
              "values of the first and the last color [0 to the 99.9th percentile]",
              {.value = "LOW,HIGH"});
}

}  // namespace

void add_convert_command(Program& program) {
  const auto a = std::make_shared<ConvertArguments>();
  Command command = program.add_command("convert", "Convert, cut out and compare images");
  declare_arguments(command, *a);
  command
      .footer(
          "Example:\n  tyndall convert a.exr error.png --reference ref.exr --error flip "
          "--false-color\n\n" +
          exit_code_help())
      .on_run([a] { return run_convert_command(*a); });
}

}  // namespace tyndall::app
