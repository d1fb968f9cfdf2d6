// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/scene_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "apps/tyndall/report/efficiency.h"
#include "apps/tyndall/report/html_text.h"
#include "apps/tyndall/text_table.h"

namespace tyndall::app {

namespace {

using Row = std::vector<std::string>;

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

std::string row_html(const Row& cells, const char* tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) {
    html += fmt::format("<{0}>{1}</{0}>", tag, escape_html(cell));
  }
  return html + "</tr>\n";
}

std::string table_html(const Row& head, const std::vector<Row>& rows) {
  std::string html =
      "<div class=\"wide\"><table><thead>" + row_html(head, "th") + "</thead><tbody>\n";
  for (const Row& row : rows) html += row_html(row, "td");
  return html + "</tbody></table></div>\n";
}

std::string mean_of(const Method& method, double (*value)(const Run&)) {
  const double mean = spread_over_runs(method.runs, value).mean;
  return std::isnan(mean) ? "-" : short_number(mean);
}

std::string mean_and_deviation(const Method& method, double (*value)(const Run&)) {
  const Spread s = spread_over_runs(method.runs, value);
  if (method.runs.size() < 2) return short_number(s.mean);
  return fmt::format("{:.4g} ± {:.2g}", s.mean, s.deviation);
}

std::string ratio_text(const std::optional<RatioEstimate>& r) {
  return r ? r->text() : "-";
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

Row cost_row(const Method& method, const Method& baseline) {
  return {method.name,
          fmt::format("{}", method.runs.size()),
          mean_of(method, [](const Run& r) { return double{1} * r.samples_per_pixel; }),
          mean_of(method, [](const Run& r) { return r.seconds; }),
          mean_of(method, [](const Run& r) { return r.training_seconds; }),
          ratio_text(cost_ratio(method.runs, baseline.runs, cost_in_time)),
          ratio_text(cost_ratio(method.runs, baseline.runs, trimmed_cost_in_time)),
          ratio_text(cost_ratio(method.runs, baseline.runs, cost_in_samples))};
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

}  // namespace

std::string summary_html(const SceneResults& scene) {
  std::string html;
  for (size_t i = 1; i < scene.methods.size(); ++i) {
    const Method& method = scene.methods[i];
    const Method& baseline = scene.methods.front();
    const auto time = cost_ratio(method.runs, baseline.runs, cost_in_time);
    if (!time) continue;
    html += fmt::format("<p><strong>{}</strong>: the same error as {} in {}.</p>\n",
                        escape_html(method.name), escape_html(baseline.name),
                        time->time_words());
  }
  return html + reference_html(scene);
}

std::string method_table_html(const SceneResults& scene) {
  std::vector<Row> errors, costs;
  for (const Method& method : scene.methods) {
    if (method.runs.empty()) continue;
    errors.push_back(error_row(method));
    costs.push_back(cost_row(method, scene.methods.front()));
  }
  return table_html({"method", "relMSE", "trimmed", "MSE", "SMAPE", "PSNR [dB]", "FLIP",
                     "HDR-FLIP", "99.9 %", "biased runs"},
                    errors) +
         table_html({"method", "runs", "samples/pixel", "seconds", "of them learning",
                     "times less time", "trimmed", "times fewer samples"},
                    costs);
}

std::string run_table_html(const SceneResults& scene) {
  std::vector<Row> rows;
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs) {
      rows.push_back({method.name, fmt::format("{}", run.seed),
                      short_number(run.errors.rel_mse),
                      short_number(run.errors.rel_mse_trimmed),
                      run.bias ? fmt::format("{:+.2g} ± {:.1g}", run.bias->mean_difference,
                                             1.96 * run.bias->standard_error)
                               : "-",
                      run.bias ? short_number(run.bias->p_value) : "-",
                      fmt::format("{}", run.samples_per_pixel), short_number(run.seconds),
                      fmt::format("{}", run.errors.not_finite),
                      fmt::format("{}", run.rejected_samples), run.image});
    }
  }
  return table_html({"method", "seed", "relMSE", "trimmed", "bias", "p", "samples/pixel",
                     "seconds", "not finite", "rejected", "image"},
                    rows);
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
  std::vector<Row> rows;
  for (const std::string& name : names) {
    rows.push_back({name});
    for (const Method& method : scene.methods) {
      rows.back().push_back(counter_text(method, name));
    }
  }
  return notes_html(scene) +
         (rows.empty() ? "<p>No counters.</p>\n" : table_html(head, rows));
}

std::string commands_html(const SceneResults& scene) {
  std::string text;
  for (const Method& method : scene.methods) {
    for (const Run& run : method.runs) text += run.command + "\n";
  }
  return "<pre>" + escape_html(text) + "</pre>\n";
}

}  // namespace tyndall::app
