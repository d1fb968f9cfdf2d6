// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/scene_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <vector>

#include "apps/tyndall/report/efficiency.h"
#include "apps/tyndall/report/error_curve.h"
#include "apps/tyndall/report/html_text.h"
#include "apps/tyndall/text_table.h"

namespace tyndall::app {

namespace {

struct Cell {
  std::string text, link;  // no link if empty

  Cell(std::string text_, std::string link_ = "")
      : text(std::move(text_)), link(std::move(link_)) {}
  Cell(const char* text_) : text(text_) {}

  std::string html() const {
    if (link.empty()) return escape_html(text);
    return fmt::format("<a href=\"{}\">{}</a>", escape_html(link), escape_html(text));
  }
};

using Row = std::vector<Cell>;

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

std::string row_html(const Row& cells, const char* tag, const std::string& attribute = "") {
  std::string html = "<tr" + attribute + ">";
  for (const Cell& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, cell.html());
  return html + "</tr>\n";
}

/// `methods`: whose rows these are, for the page's filter; empty: nobody's.
std::string table_html(const Row& head, const std::vector<Row>& rows,
                       const std::vector<size_t>& methods = {}) {
  std::string html =
      "<div class=\"wide\"><table><thead>" + row_html(head, "th") + "</thead><tbody>\n";
  for (size_t i = 0; i < rows.size(); ++i) {
    html += row_html(rows[i], "td",
                     methods.empty() ? "" : fmt::format(" data-method=\"{}\"", methods[i]));
  }
  return html + "</tbody></table></div>\n";
}

std::string mean_of(const Method& method, double (*value)(const Run&)) {
  const double mean = spread_over_runs(method.runs, value).mean;
  return std::isnan(mean) ? "-" : short_number(mean);
}

std::string fixed_mean(const Method& method, double (*value)(const Run&)) {
  return fmt::format("{:.2f}", spread_over_runs(method.runs, value).mean);
}

std::string mean_and_deviation(const Method& method, double (*value)(const Run&)) {
  const Spread s = spread_over_runs(method.runs, value);
  if (method.runs.size() < 2) return short_number(s.mean);
  return fmt::format("{:.4g} ± {:.2g}", s.mean, s.deviation);
}

/// "bias" of all runs: how many of them differ from the reference at 5 % for their tiles
/// together.
std::string bias_text(const Method& method) {
  int tested = 0, rejected = 0;
  for (const Run& run : method.runs) {
    tested += run.bias.has_value();
    rejected += run.bias && run.bias->rejected_tiles > 0;
  }
  return tested == 0 ? "-" : fmt::format("{}/{}", rejected, tested);
}

Row error_row(const Method& method) {
  return {method.name,
          mean_and_deviation(method, [](const Run& r) { return r.errors.rel_mse; }),
          mean_of(method, [](const Run& r) { return r.errors.rel_mse_trimmed; }),
          mean_of(method, [](const Run& r) { return r.errors.mse; }),
          mean_of(method, [](const Run& r) { return r.errors.smape; }),
          mean_of(method, [](const Run& r) { return r.errors.psnr; }),
          mean_of(method,
                  [](const Run& r) { return r.errors.ldr_flip.value_or(not_measured); }),
          mean_of(method,
                  [](const Run& r) { return r.errors.hdr_flip.value_or(not_measured); }),
          mean_of(method, [](const Run& r) { return r.errors.percentile_99_9; }),
          bias_text(method)};
}

/// The samples per pixel that all runs of all methods reached.
double common_samples(const SceneResults& scene) {
  double samples = std::numeric_limits<double>::infinity();
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs)
      samples = std::min(samples, double{1} * run.samples_per_pixel);
  }
  return samples;
}

std::string error_at_text(const Method& method, double samples) {
  const auto error = error_at(method, CurveAxis::samples_per_pixel, samples);
  return error ? short_number(*error) : "-";
}

Row cost_row(const Method& method, const Method& baseline, double samples) {
  return {method.name,
          fmt::format("{}", method.runs.size()),
          mean_of(method, [](const Run& r) { return double{1} * r.samples_per_pixel; }),
          mean_of(method, [](const Run& r) { return r.seconds; }),
          fixed_mean(method, [](const Run& r) { return r.training_seconds; }),
          mean_of(method, [](const Run& r) { return 1e-6 * double(r.paths) / r.seconds; }),
          mean_of(method,
                  [](const Run& r) {
                    return std::round(1e-6 * r.peak_memory_bytes.value_or(not_measured));
                  }),
          ratio_text(method, baseline, cost_in_time),
          ratio_text(method, baseline, trimmed_cost_in_time),
          ratio_text(method, baseline, cost_in_samples),
          error_at_text(method, samples)};
}

std::string counter_text(const Method& method, const std::string& name) {
  double sum = 0;
  int count = 0;
  for (const Run& run : method.runs) {
    const auto found = run.counters.find(name);
    if (found == run.counters.end()) continue;
    sum += found->second;
    ++count;
  }
  return count == 0 ? "" : short_number(sum / count);
}

std::string notes_html(const SceneResults& scene) {
  std::set<std::string> notes;
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs) {
      for (const std::string& note : run.notes) notes.insert(method.name + ": " + note);
    }
  }
  std::string html;
  for (const std::string& note : notes) html += "<li>" + escape_html(note) + "</li>\n";
  return html.empty() ? "" : "<ul>\n" + html + "</ul>\n";
}

/// Warns where the reference's own noise is part of the measured errors.
std::string reference_html(const SceneResults& scene) {
  if (!scene.reference_rel_mse) return "";
  return fmt::format(
      "<p class=\"quiet\">The reference itself has {:.0f} samples per pixel and a "
      "relMSE of about {:.2g}{}.</p>\n",
      scene.reference_samples_per_pixel, *scene.reference_rel_mse,
      is_reference_noisy(scene)
          ? ", which is more than a tenth of the smallest error measured with it: "
            "the true ratios are further from 1"
          : "");
}

Row run_row(const Method& method, const Run& run, const std::string& folder) {
  const std::string bias = run.bias
                               ? fmt::format("{:+.2g} ± {:.1g}", run.bias->mean_difference,
                                             1.96 * run.bias->standard_error)
                               : "-";
  return {method.name,
          fmt::format("{}", run.seed),
          short_number(run.errors.rel_mse),
          short_number(run.errors.rel_mse_trimmed),
          bias,
          run.bias ? short_number(run.bias->p_value) : "-",
          fmt::format("{}", run.samples_per_pixel),
          short_number(run.seconds),
          fmt::format("{}", run.errors.not_finite),
          fmt::format("{}", run.rejected_samples),
          Cell(run.image, (std::filesystem::path(folder) / run.image).string())};
}

}  // namespace

std::string summary_html(const SceneResults& scene) {
  std::string html;
  for (size_t i = 1; i < scene.methods.size(); ++i) {
    const Method& method = scene.methods[i];
    const std::string sentence = time_sentence(method, scene.methods.front());
    if (sentence.empty()) continue;
    html += fmt::format("<p><strong>{}</strong>: {}.</p>\n", escape_html(method.name),
                        escape_html(sentence));
  }
  return html + reference_html(scene);
}

std::string filter_html(const SceneResults& scene) {
  std::string html = "<div class=\"bar filter\" hidden>";
  for (size_t i = 0; i < scene.methods.size(); ++i) {
    html += fmt::format(
        "<label><input type=\"checkbox\" checked data-method=\"{}\"> {}</label>", i,
        escape_html(scene.methods[i].name));
  }
  return html + "</div>\n";
}

std::string method_table_html(const SceneResults& scene) {
  std::vector<Row> errors, costs;
  std::vector<size_t> methods;
  const double samples = common_samples(scene);
  for (size_t i = 0; i < scene.methods.size(); ++i) {
    const Method& method = scene.methods[i];
    if (method.runs.empty()) continue;
    errors.push_back(error_row(method));
    costs.push_back(cost_row(method, scene.methods.front(), samples));
    methods.push_back(i);
  }
  return table_html({"method", "relMSE", "trimmed", "MSE", "SMAPE", "PSNR [dB]", "FLIP",
                     "HDR-FLIP", "99.9 %", "biased runs"},
                    errors, methods) +
         table_html({"method", "runs", "spp", "seconds", "of them learning", "Mpaths/s",
                     "MB", "times less time", "trimmed", "times fewer samples",
                     fmt::format("relMSE at {:g} spp", samples)},
                    costs, methods);
}

std::string run_table_html(const SceneResults& scene, const std::string& folder) {
  std::vector<Row> rows;
  std::vector<size_t> methods;
  for (size_t i = 0; i < scene.methods.size(); ++i) {
    for (const Run& run : scene.methods[i].runs) {
      rows.push_back(run_row(scene.methods[i], run, folder));
      methods.push_back(i);
    }
  }
  return table_html({"method", "seed", "relMSE", "trimmed", "bias", "p", "samples/pixel",
                     "seconds", "not finite", "rejected", "image"},
                    rows, methods);
}

std::string diagnostics_html(const SceneResults& scene) {
  std::set<std::string> names;
  Row head = {"counter"};
  for (const Method& method : scene.methods) {
    head.push_back(method.name);
    for (const Run& run : method.runs) {
      for (const auto& [name, value] : run.counters) names.insert(name);
    }
  }
  std::vector<Row> rows = {{"learning, % of the time"}};
  for (const Method& method : scene.methods) {
    rows.back().push_back(fixed_mean(
        method, [](const Run& r) { return 100 * r.training_seconds / r.seconds; }));
  }
  for (const std::string& name : names) {
    rows.push_back({name});
    for (const Method& method : scene.methods) {
      rows.back().push_back(counter_text(method, name));
    }
  }
  return notes_html(scene) + table_html(head, rows);
}

std::string commands_html(const SceneResults& scene) {
  std::string text;
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs) text += run.command + "\n";
  }
  return fmt::format("<p class=\"quiet\">{}, {} x {}, hash {}</p>\n<pre>{}</pre>\n",
                     escape_html(scene.path), scene.width, scene.height,
                     escape_html(scene.hash), escape_html(text));
}

}  // namespace tyndall::app
