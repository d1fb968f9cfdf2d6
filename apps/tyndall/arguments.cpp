// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "apps/tyndall/nearest_name.h"
#include "apps/tyndall/parse_values.h"
#include "apps/tyndall/shell_line.h"

namespace tyndall::app {

namespace {

constexpr size_t name_width = 34, help_width = 66;

/// "--long-name" of CLI11's list of names, or the only name there is.
std::string long_name(const std::string& names) {
  const size_t begin = names.find("--");
  return begin == std::string::npos ? names
                                    : names.substr(begin, names.find(',', begin) - begin);
}

std::string environment_name(const std::string& names) {
  std::string result = "TYNDALL_";
  for (const char c : long_name(names).substr(2))
    result +=
        c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// Breaks text at spaces into lines of at most help_width characters.
std::string wrap(const std::string& text) {
  std::istringstream words(text);
  std::string result, word;
  size_t column = 0;
  while (words >> word) {
    const bool fits = column + 1 + word.size() <= help_width;
    if (!result.empty()) result += fits ? ' ' : '\n';
    column = fits ? column + 1 + word.size() : word.size();
    result += word;
  }
  return result;
}

/// CLI11's help without doubled empty lines.
class CompactFormatter : public CLI::Formatter {
 public:
  CompactFormatter() {
    column_width(name_width);
    label("Positionals", "Arguments");
    label("SUBCOMMAND", "COMMAND");
    label("OPTIONS", "options");
  }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    for (size_t at = text.find("\n\n\n"); at != text.npos; at = text.find("\n\n\n", at))
      text.erase(at, 1);
    return text;
  }
};

/// Turns a target into a function of the argument's text.
struct MakeParser {
  template <typename Number>
  ArgumentParser operator()(Number* target) const {
    return [target](const std::string& text) { *target = parse_number<Number>(text); };
  }
  template <typename Value>
  ArgumentParser operator()(std::optional<Value>* target) const {
    return [target](const std::string& text) {
      Value value{};
      MakeParser{} (&value)(text);
      *target = value;
    };
  }
  ArgumentParser operator()(std::string* target) const {
    return [target](const std::string& text) { *target = text; };
  }
  ArgumentParser operator()(std::vector<std::string>* target) const {
    return [target](const std::string& text) { target->push_back(text); };
  }
  ArgumentParser operator()(ArgumentParser parser) const { return parser; }
};

void check_choice(const std::string& text, const std::vector<std::string>& choices) {
  if (choices.empty() || std::find(choices.begin(), choices.end(), text) != choices.end())
    return;
  throw std::invalid_argument(fmt::format("must be {}{}, got '{}'",
                                          choices.size() > 1 ? "one of " : "",
                                          fmt::join(choices, ", "), text));
}

/// The name to blame: the option, or the environment variable that the text came from.
std::string blame(const std::string& name, const std::string& variable,
                  const std::string& text) {
  const char* value = variable.empty() ? nullptr : std::getenv(variable.c_str());
  return value && text == value ? variable : name;
}

CLI::Option* add(CLI::App& app, const std::string& names, const std::string& variable,
                 const ArgumentTarget& target, const std::string& help,
                 const ArgumentStyle& style) {
  const bool is_list =
      style.repeatable || std::holds_alternative<std::vector<std::string>*>(target);
  const auto read = [name = long_name(names), variable, choices = style.choices,
                     parse =
                         std::visit(MakeParser{}, target)](const CLI::results_t& texts) {
    for (const std::string& text : texts) {
      try {
        check_choice(text, choices);
        parse(text);
      } catch (const std::invalid_argument& error) {
        throw CLI::ValidationError(blame(name, variable, text), error.what());
      }
    }
    return true;
  };
  CLI::Option* option = app.add_option(names, read, wrap(help));
  option->option_text(style.choices.empty()
                          ? style.value
                          : fmt::format("{}", fmt::join(style.choices, "|")));
  option->type_size(1)->group(style.group)->required(style.required)->envname(variable);
  option->multi_option_policy(is_list ? CLI::MultiOptionPolicy::TakeAll
                                      : CLI::MultiOptionPolicy::TakeLast);
  return option;
}

/// The subcommand that was asked for, or the program itself.
const CLI::App& innermost(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : *chosen.front();
}

std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent ? parent->get_name() + " " : "") + command.get_name();
}

/// What may stand where an unknown word stands: options, or subcommands.
std::vector<std::string> known_names(const CLI::App& command, bool is_option) {
  std::vector<std::string> names;
  if (is_option) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  } else {
    for (const CLI::App* child : command.get_subcommands(nullptr))
      names.push_back(child->get_name());
  }
  return names;
}

/// The first word that nothing took, with the nearest name that there is.
std::string describe_unknown(const std::string& word, const CLI::App& command) {
  const std::string nearest =
      nearest_name(word.substr(0, word.find('=')), known_names(command, word[0] == '-'));
  const char* kind = word[0] != '-' && !command.get_parent() ? "command" : "argument";
  return fmt::format("unknown {} '{}'{}", kind, word,
                     nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
}

/// CLI11's complaint in our words, where those are better.
std::string describe(const CLI::ParseError& error, const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining(true);
  if (!rest.empty() && !rest.front().empty())
    return describe_unknown(rest.front(), command);
  if (error.get_name() == "ArgumentMismatch") {
    const std::string text = error.what();
    return text.substr(0, text.find(':')) + " requires a value";
  }
  if (!command.get_parent() && error.get_name() == "RequiredError")
    return "a command is required";
  return error.what();
}

}  // namespace

Command& Command::positional(const std::string& name, const ArgumentTarget& target,
                             const std::string& help, const ArgumentStyle& style) {
  CLI::Option* option = add(*app_, name, "", target, help, style);
  option->option_text(" ");
  if (std::holds_alternative<std::vector<std::string>*>(target)) option->expected(-1);
  return *this;
}

Command& Command::option(const std::string& names, const ArgumentTarget& target,
                         const std::string& help, const ArgumentStyle& style) {
  // One value for each occurrence, so that "-o a.exr scene.pbrt" leaves the scene alone.
  add(*app_, names, environment_name(names), target, help, style)
      ->expected(1)
      ->allow_extra_args(false);
  return *this;
}

Command& Command::flag(const std::string& names, bool* target, const std::string& help,
                       const std::string& group) {
  app_->add_flag(names, *target, wrap(help))
      ->group(group)
      ->option_text(" ")
      ->envname(environment_name(names));
  return *this;
}

Command& Command::footer(const std::string& text) {
  app_->footer(text);
  return *this;
}

Command& Command::on_run(std::function<ExitCode()> run) {
  app_->callback([selected = selected_, run = std::move(run)] { *selected = run; });
  return *this;
}

Program::Program(const std::string& name, const std::string& description,
                 const std::string& version)
    : app_(std::make_unique<CLI::App>(description, name)) {
  app_->formatter(std::make_shared<CompactFormatter>());
  app_->set_version_flag("--version", version,
                         "Print the version and what it was built with");
  app_->set_help_flag("-h,--help", "Print this help");
  app_->require_subcommand(1);
  app_->footer(
      fmt::format("'{} COMMAND --help' explains a command. Every option --some-name may "
                  "also be given as\nthe environment variable TYNDALL_SOME_NAME; the "
                  "command line wins.\n\n{}",
                  name, exit_code_help()));
}

Program::~Program() = default;

Command Program::add_command(const std::string& name, const std::string& description) {
  CLI::App* command = app_->add_subcommand(name, wrap(description))->group("Commands");
  command->footer("");
  return Command(command, &selected_);
}

ExitCode Program::run(int argc, const char* const* argv) {
  command_line_ = shell_line(argc, argv);
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return explain(error);
  }
  return run_guarded(selected_);
}

ExitCode Program::explain(const CLI::ParseError& error) const {
  if (error.get_exit_code() == 0) {  // help or version
    app_->exit(error);
    return ExitCode::done;
  }
  const CLI::App& command = innermost(*app_);
  fmt::print(stderr, "error: {}\nSee '{} --help'.\n", describe(error, command),
             full_name(command));
  return ExitCode::usage;
}

}  // namespace tyndall::app
