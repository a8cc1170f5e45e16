// SPDX-License-Identifier: MIT
#include "support/common_options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <system_error>
#include <vector>

#include "support/concat.hpp"
#include "support/python_script.hpp"

CLI::Option* add_output_option(CLI::App& app, std::filesystem::path& folder, const std::string& description) {
  return app.add_option("-o,--output", folder, description)->capture_default_str();
}

CLI::Option* add_csv_option(CLI::App& app, std::filesystem::path& file, const std::string& description) {
  return app.add_option("--csv", file, description);
}

CLI::Option* add_no_plot_option(CLI::App& app, bool& no_plot, const std::string& picture) {
  return app.add_flag("--no-plot", no_plot,
                      concat("do not draw ", picture, ".png and .svg, which need Python with matplotlib"));
}

CLI::Option* add_python_option(CLI::App& app, std::string& python, const std::string& use) {
  python = default_python();
  return app
      .add_option("--python", python, concat("Python interpreter ", use, "; default: $SPLINERTIA_PYTHON or python3"))
      ->capture_default_str();
}

CLI::Option* add_rate_option(CLI::App& app, double& rate, const std::string& description) {
  return app.add_option("--rate", rate, description)->capture_default_str();
}

CLI::Option* add_rate_option(CLI::App& app, std::optional<double>& rate, const std::string& description) {
  return app.add_option("--rate", rate, description);
}

CLI::Option* add_seed_option(CLI::App& app, std::uint64_t& seed, const std::string& description) {
  const auto read = [&seed](const std::string& text) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc{} || end != text.data() + text.size()) {
      throw CLI::ValidationError("--seed", text + ", expected a whole number from 0 to 18446744073709551615");
    }
  };
  return app.add_option_function<std::string>("--seed", read, description)->default_str(std::to_string(seed));
}

CLI::Option* add_gravity_option(CLI::App& app, GravityOption& gravity) {
  const auto read = [&gravity](const std::vector<double>& numbers) {
    const auto refuse = [](const auto&... what) { throw CLI::ValidationError("--gravity", concat(what...)); };
    for (const double number : numbers) {
      if (!std::isfinite(number)) refuse(number, ", expected finite numbers");
    }
    if (numbers.size() == 3) {
      gravity.vector = Eigen::Vector3d(numbers.data());
    } else if (numbers.size() != 1) {
      refuse(numbers.size(), " numbers, expected 1 or 3");
    } else if (numbers[0] < 0) {
      refuse(numbers[0], ", expected a magnitude >= 0, which acts along -z, or a vector x y z");
    } else {
      gravity.vector = {0, 0, -numbers[0]};
    }
  };
  return app
      .add_option_function<std::vector<double>>(
          "--gravity", read, "acceleration of free fall in the world [m/s^2]: x y z, or its magnitude along -z")
      ->expected(1, 3)
      ->check(CLI::Number)
      ->default_str("0 0 -9.80665");
}
