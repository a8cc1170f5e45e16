// SPDX-License-Identifier: MIT
// The speed/accuracy study (docs/speed_and_accuracy.md): runs one part and writes its csv. benchmarks/study.py runs
// them all.
#include "study/study.hpp"

#include <CLI/CLI.hpp>
#include <map>

int main(int argc, char** argv) {
  const std::map<std::string, void (*)(const study::Options&)> parts{{"representation", study::representation},
                                                                     {"integrators", study::integrators},
                                                                     {"error_terms", study::error_terms},
                                                                     {"allan", study::allan}};
  std::vector<std::string> names;
  for (const auto& [name, run] : parts) names.push_back(name);

  CLI::App app{"One part of the speed/accuracy study: measures on this machine, writes FOLDER/PART.csv."};
  study::Options options;
  std::string part;
  app.add_option("--part", part, "what to study")->required()->check(CLI::IsMember(names));
  app.add_option("--output", options.output, "folder for the csv file, made if it is not there")
      ->required()
      ->type_name("FOLDER");
  app.add_option("--repetitions", options.repetitions, "of every time")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--data", options.data, "a real trajectory for representation: TUM, or csv as EuRoC has it")
      ->type_name("FILE");
  app.add_flag("--quick", options.quick, "seconds instead of minutes, to see that it works");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    std::filesystem::create_directories(options.output);
    parts.at(part)(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "study: %s\n", error.what());
    return 2;
  }
  return 0;
}
