// SPDX-License-Identifier: MIT
/// golden_report DIR: checks a folder of reference values (format: README.md), and prints for each file, class and
/// scalar type the number of rows and the worst error in units of its grade. Exit code 0: within all limits; 1: a limit
/// is passed; 2: bad usage, or a folder or file that cannot be read.
#include <exception>
#include <iostream>

#include "golden_checks.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: golden_report DIR\n";
    return 2;
  }
  try {
    const golden::Report report = golden::check_folder(argv[1]);
    report.print(std::cout);
    std::cout << (report.passed() ? "All within their limits.\n" : "LIMIT PASSED\n");
    return report.passed() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "golden_report: " << error.what() << '\n';
    return 2;
  }
}
