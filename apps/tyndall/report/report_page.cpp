// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "apps/tyndall/report/error_curve.h"
#include "apps/tyndall/report/html_text.h"
#include "apps/tyndall/report/report_assets.h"
#include "apps/tyndall/report/scene_pictures.h"
#include "apps/tyndall/report/scene_tables.h"
#include "apps/tyndall/text_table.h"
#include "tyndall/image/codec.h"
#include "tyndall/image/metrics.h"
#include "tyndall/image/whole_file.h"

namespace tyndall::app {

namespace {

double mean_finite(const std::vector<float>& values) {
  double sum = 0;
  size_t count = 0;
  for (const float x : values) {
    if (!std::isfinite(x)) continue;
    sum += double{x};
    ++count;
  }
  return sum / static_cast<double>(count);
}

/// A scene with its pictures and the results that it is part of.
struct PageScene {
  const SceneResults* scene;
  const Results* results;
  std::string folder, link_folder;  ///< of the results
  ScenePictures pictures;
};

std::string plots_html(const SceneResults& scene, double time_limit) {
  const ScenePlots plots = scene_plots(scene, time_limit);
  return "<div class=\"plots\">" + plots.time + plots.samples + "</div>\n";
}

std::string inset_cell(const ScenePicture& picture, const Image& reference,
                       const Inset& inset, const ToneMapping& tone, double epsilon) {
  const Image part = cut_out(picture.image, inset);
  const std::string error = picture.flip.empty()
                                ? ""
                                : short_number(mean_finite(relative_square_errors(
                                      part, cut_out(reference, inset), epsilon)));
  return fmt::format(
      "<td><img data-inset=\"{0},{1},{2}\" width=\"{2}\" height=\"{2}\" alt=\"{3} at {0}, "
      "{1}\" src=\"{4}\"><span class=\"quiet\">{5}</span></td>",
      inset.x, inset.y, inset.size, escape_html(picture.name),
      png_url(encode_png(part, tone)), error);
}

std::string insets_html(const ScenePictures& pictures, double epsilon) {
  const ToneMapping tone{.exposure = pictures.exposure};
  const Image& reference = pictures.pictures.front().image;
  std::string html = fmt::format(
      "<div class=\"wide\"><table class=\"insets\" style=\"--columns: {}\"><tr>",
      pictures.pictures.size());
  for (const ScenePicture& picture : pictures.pictures) {
    html += "<th>" + escape_html(picture.name) + "</th>";
  }
  html += "</tr>\n";
  for (const Inset& inset : pictures.insets) {
    html += "<tr>";
    for (const ScenePicture& picture : pictures.pictures) {
      html += inset_cell(picture, reference, inset, tone, epsilon);
    }
    html += "</tr>\n";
  }
  return html + fmt::format(
                    "</table></div>\n<p class=\"quiet\">relMSE of each part, of one run; "
                    "shown {:+g} "
                    "stops brighter than the file. A click shows the place above.</p>\n",
                    pictures.exposure);
}

/// The pictures that `tyndall inspect` drew of the scene, by their names.
std::string inspection_html(const PageScene& page) {
  const std::filesystem::path folder = page.folder.empty() ? "." : page.folder;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(page.scene->name + "-inspect") && name.ends_with(".png")) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::string html;
  for (const auto& file : files) {
    html += fmt::format(
        "<figure class=\"inspected\"><img alt=\"{0}\" src=\"{1}\"><figcaption "
        "class=\"quiet\">{0}</figcaption></figure>\n",
        escape_html(file.filename().string()), png_url(read_whole_file(file.string())));
  }
  return html;
}

std::string scene_html(const PageScene& page, int number) {
  const SceneResults& scene = *page.scene;
  std::string html = fmt::format("<section id=\"scene-{0}\">\n<h2>{1}</h2>\n", number,
                                 escape_html(scene.name));
  html += "<div class=\"summary\">" + summary_html(scene) + "</div>\n";
  html += fmt::format(
      "<div class=\"viewer\" data-scene=\"{}\"><noscript>The pictures need JavaScript; "
      "tables, "
      "plots and insets do not.</noscript></div>\n",
      number);
  html += "<h3>Where they differ most</h3>\n" +
          insets_html(page.pictures, page.results->epsilon);
  html +=
      "<h3>Error</h3>\n" + filter_html(scene) + plots_html(scene, page.results->time_limit);
  html +=
      "<p class=\"quiet\">Lines: geometric means over the seeds; bands: smallest to "
      "largest; "
      "dashed: equal time; a thick mark on the axis: where learning ends.</p>\n";
  html += "<h3>Methods</h3>\n" + method_table_html(scene);
  html += fmt::format(
      "<p class=\"quiet\">relMSE with epsilon {:g}, mean ± standard deviation over the "
      "seeds; "
      "trimmed: without the worst 0.1 % of the pixels; 99.9 %: percentile of the absolute "
      "error; "
      "biased runs: those with a tile of 16 x 16 pixels whose mean differs from the "
      "reference's "
      "at 5 % for all tiles together; ratios against {} with 95 % confidence.</p>\n",
      page.results->epsilon, escape_html(scene.methods.front().name));
  html += "<details><summary>All runs</summary>\n" +
          run_table_html(scene, page.link_folder) + "</details>\n";
  html += "<h3>Diagnostics</h3>\n" + diagnostics_html(scene) + inspection_html(page);
  html += "<h3>The same images again</h3>\n" + commands_html(scene);
  return html + "</section>\n";
}

std::string machine_html(const Results& r) {
  return fmt::format(
      "<p class=\"quiet\">{} at commit {}, {} ({}). {}, {} cores, {:.0f} GiB, {}; {} "
      "threads. "
      "{}.</p>\n<pre>{}</pre>\n",
      escape_html(r.program), escape_html(r.commit), escape_html(r.compiler),
      escape_html(r.flags), escape_html(r.machine.cpu), r.machine.cores,
      r.machine.memory_bytes / (1 << 30), escape_html(r.machine.system), r.threads,
      escape_html(r.created), escape_html(r.command));
}

std::string head_html(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{0}</title>\n<style>\n{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      escape_html(title), asset::report_css);
}

/// "volpath, learned: fog", or how many scenes there are.
std::string page_title(const std::vector<PageScene>& scenes) {
  if (scenes.size() != 1) return fmt::format("{} scenes", scenes.size());
  std::string names;
  for (const Method& method : scenes.front().scene->methods) {
    names += (names.empty() ? "" : ", ") + method.name;
  }
  return names + ": " + scenes.front().scene->name;
}

std::string navigation_html(const std::vector<PageScene>& scenes) {
  if (scenes.size() < 2) return "";
  std::string html = "<nav>";
  for (size_t i = 0; i < scenes.size(); ++i) {
    html +=
        fmt::format("<a href=\"#scene-{}\">{}</a>", i, escape_html(scenes[i].scene->name));
  }
  return html + "</nav>\n";
}

std::string data_html(const std::vector<PageScene>& scenes, int steps) {
  std::string descriptions, data;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const PackedPictures packed = pack_pictures(
        scenes[i].pictures, scenes[i].results->epsilon, steps, static_cast<int>(i));
    descriptions += (i > 0 ? "," : "") + packed.description;
    data += packed.data;
  }
  return fmt::format("<script type=\"application/json\" id=\"pictures\">[{}]</script>\n{}",
                     descriptions, data);
}

}  // namespace

ScenePlots scene_plots(const SceneResults& scene, double time_limit) {
  std::vector<ErrorCurve> time, samples;
  for (const Method& method : scene.methods) {
    time.push_back(error_curve(method, CurveAxis::seconds));
    samples.push_back(error_curve(method, CurveAxis::samples_per_pixel));
  }
  return {svg_plot(time, "seconds of rendering, learning included", time_limit),
          svg_plot(samples, "samples per pixel", 0)};
}

std::string report_page(const std::vector<ReportInput>& inputs) {
  std::vector<PageScene> scenes;
  std::string machines;
  for (const ReportInput& input : inputs) {
    machines += machine_html(input.results);
    for (const SceneResults& scene : input.results.scenes) {
      scenes.push_back({&scene, &input.results, input.folder, input.link_folder,
                        read_pictures(scene, input.folder)});
    }
  }
  std::string text = head_html(page_title(scenes)) + navigation_html(scenes);
  for (size_t i = 0; i < scenes.size(); ++i)
    text += scene_html(scenes[i], static_cast<int>(i));
  text += "<h2>Made with</h2>\n" + machines + asset::help_html;
  const std::string scripts =
      fmt::format("<script>\n{}{}{}</script>\n</body>\n</html>\n", asset::pictures_js,
                  asset::viewer_js, asset::page_js);
  for (const int steps : {32, 16, 8, 4}) {
    std::string page = fmt::format("{}{}{}", text, data_html(scenes, steps), scripts);
    if (page.size() <= report_size_limit) return page;
  }
  throw std::runtime_error(
      fmt::format("the page would have more than {} MB; give fewer results",
                  report_size_limit / 1'000'000));
}

}  // namespace tyndall::app
