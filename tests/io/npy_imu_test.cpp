// SPDX-License-Identifier: MIT
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <splinertia/io/npy_imu.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;
using test::content;
using test::error_of;

namespace {

using Limits = std::numeric_limits<double>;

std::vector<ImuSample<double, nanoseconds>> samples(int size) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Eigen::Vector3d::NullaryExpr([&] { return normal(random); }).eval(); };
  std::vector<ImuSample<double, nanoseconds>> result;
  for (int i = 0; i < size; ++i)
    result.push_back({nanoseconds{1403636579758555393 + 5'000'000LL * i}, vector(), vector()});
  result[0].gyro = {-0.0, Limits::denorm_min(), Limits::max()};
  result[0].accel = {Limits::lowest(), Limits::min(), 0.1};
  return result;
}

void check_same(const std::vector<ImuSample<double, nanoseconds>>& a,
                const std::vector<ImuSample<double, nanoseconds>>& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].time == b[i].time);
    for (int axis = 0; axis < 3; ++axis) {
      REQUIRE(bits(a[i].gyro[axis]) == bits(b[i].gyro[axis]));
      REQUIRE(bits(a[i].accel[axis]) == bits(b[i].accel[axis]));
    }
  }
}

}  // namespace

TEST_CASE("samples read back to the same bits, written at once or one by one") {
  const test::TemporaryDirectory folder;
  const auto written = samples(5000);
  write_npy_imu(folder / "imu.npy", written);
  check_same(read_npy_imu(folder / "imu.npy"), written);
  NpyImuWriter writer(folder / "stream.npy");
  for (const ImuSample<double, nanoseconds>& sample : written) writer.append(sample);
  CHECK_FALSE(std::filesystem::exists(folder / "stream.npy"));
  writer.commit();
  CHECK(content(folder / "stream.npy") == content(folder / "imu.npy"));
}

TEST_CASE("samples in seconds are written as the same in nanoseconds") {
  const test::TemporaryDirectory folder;
  struct InSeconds {
    double time;
    Eigen::Vector3d gyro, accel;
  };
  std::vector<InSeconds> in_seconds;
  std::vector<ImuSample<double, nanoseconds>> written = samples(100);
  for (ImuSample<double, nanoseconds>& sample : written) {
    const double time = static_cast<double>(in_seconds.size()) * 0.005 - 0.1;
    in_seconds.push_back({time, sample.gyro, sample.accel});
    sample.time = to_nanoseconds(time);
  }
  write_npy_imu(folder / "imu.npy", in_seconds);
  check_same(read_npy_imu(folder / "imu.npy"), written);
  in_seconds.back().time = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(write_npy_imu(folder / "nan.npy", in_seconds), std::invalid_argument);
}

TEST_CASE("the file is what NumPy's format says, byte by byte") {
  const test::TemporaryDirectory folder;
  write_npy_imu(folder / "imu.npy",
                std::vector<ImuSample<double, nanoseconds>>{{nanoseconds{258}, {1, -2, 0.5}, {0, 3, -0.25}}});
  const std::string dict =
      "{'descr': [('time_ns', '<i8'), ('gyro', '<f8', (3,)), ('accel', '<f8', (3,))], 'fortran_order': False, "
      "'shape': (1,), }";
  const std::string_view records{
      "\x02\x01\0\0\0\0\0\0"
      "\0\0\0\0\0\0\xF0\x3F"
      "\0\0\0\0\0\0\x00\xC0"
      "\0\0\0\0\0\0\xE0\x3F"
      "\0\0\0\0\0\0\x00\x00"
      "\0\0\0\0\0\0\x08\x40"
      "\0\0\0\0\0\0\xD0\xBF",
      56};
  CHECK(content(folder / "imu.npy") == std::string("\x93NUMPY\x01\0\xB6\0", 10) + dict +
                                           std::string(192 - 10 - 1 - dict.size(), ' ') + "\n" + std::string(records));
}

TEST_CASE("what the reader would refuse is not written") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "imu.npy";
  CHECK(error_of<std::invalid_argument>([&] { write_npy_imu(path, std::vector<ImuSample<double, nanoseconds>>{}); }) ==
        path.string() + ": no rows to write");
  auto bad = samples(1000);
  bad[900].time = bad[899].time;
  CHECK(error_of<std::invalid_argument>([&] { write_npy_imu(path, bad); }) ==
        path.string() + ": time 1403636584253555393 ns follows 1403636584253555393 ns, expected increasing times");
  for (const auto& [value, text] : {std::pair(Limits::quiet_NaN(), "nan"), std::pair(-Limits::infinity(), "-inf")}) {
    bad = samples(1000);
    bad[900].accel.y() = value;
    CHECK(error_of<std::invalid_argument>([&] { write_npy_imu(path, bad); }) ==
          path.string() + ": cannot write " + text + ", expected a finite number");
  }
  CHECK(folder.files() == 0);
}

TEST_CASE("bad files are refused by place") {
  const test::TemporaryDirectory folder;
  write_npy_imu(folder / "imu.npy", samples(3));
  const std::string good = content(folder / "imu.npy");
  const auto error_in = [&](std::string_view bytes) {
    const auto path = folder.write("bad.npy", bytes);
    return error_of<std::runtime_error>([&] { (void)read_npy_imu(path); }).substr(path.string().size());
  };
  const auto changed = [&](std::size_t row, std::size_t column, auto value) {
    std::string bytes = good;
    store_little_endian(bytes.data() + 192 + 56 * row + 8 * column, value);
    return bytes;
  };
  CHECK(error_in(changed(1, 3, Limits::quiet_NaN())) == ": row 1: gyro[2] is nan, expected a finite number");
  CHECK(error_in(changed(2, 4, -Limits::infinity())) == ": row 2: accel[0] is -inf, expected a finite number");
  CHECK(error_in(changed(2, 0, std::int64_t{-5})) ==
        ": row 2: time_ns -5 follows 1403636579763555393, expected increasing times");
  CHECK(error_in(changed(1, 0, std::int64_t{1403636579758555393})) ==
        ": row 1: time_ns 1403636579758555393 follows 1403636579758555393, expected increasing times");
  CHECK(error_in(good.substr(0, good.size() - 1)) == ": byte 359: the file ends in row 2, expected 3 rows");
  CHECK(error_in(good + '\0') == ": byte 360: more bytes after the last of 3 rows, expected the end of the file");
  CHECK(error_in("#timestamp [ns],w\n") == ": byte 0: \"#times\", expected an .npy file, which begins with \\x93NUMPY");
  std::string other = good;
  other.replace(other.find("'gyro'"), 6, "'rate'");
  CHECK(error_in(other) ==
        ": byte 10: descr is \"[('time_ns','<i8'),('rate','<f8',(3,)),('accel','<f8',(3,))]\", expected [('time_ns', "
        "'<i8'), ('gyro', '<f8', (3,)), ('accel', '<f8', (3,))]");
}

TEST_CASE("NumPy reads what is written, and what NumPy writes is read") {
  const char* const chosen = std::getenv("SPLINERTIA_PYTHON");
  const std::string python = chosen ? chosen : "python3";
  const test::TemporaryDirectory folder;
  const auto run = [&](std::string_view script) {
    const auto path = folder.write("script.py", script);
    const std::string command =
        "\"" + python + "\" \"" + path.string() + "\" > \"" + (folder / "output.txt").string() + "\" 2>&1";
    return std::system(command.c_str()) == 0;
  };
  if (!run("import numpy\n")) SKIP("needs the Python package numpy, which " + python + " has not");
  const auto written = samples(1000);
  write_npy_imu(folder / "imu.npy", written);
  const bool good =
      run("import numpy, os, sys\n"
          "os.chdir(os.path.dirname(os.path.abspath(__file__)))\n"
          "imu = numpy.load('imu.npy')\n"
          "assert imu.shape == (1000,)\n"
          "assert imu.dtype == [('time_ns', '<i8'), ('gyro', '<f8', (3,)), ('accel', '<f8', (3,))]\n"
          "assert imu['time_ns'][0] == 1403636579758555393\n"
          "assert (numpy.diff(imu['time_ns']) == 5000000).all()\n"
          "assert imu['gyro'][0, 2] == sys.float_info.max and imu['accel'][0, 2] == 0.1\n"
          "mapped = numpy.load('imu.npy', mmap_mode='r')\n"
          "assert mapped[1:].tobytes() == imu[1:].tobytes()\n"
          "numpy.save('again.npy', imu)\n"
          "numpy.save('packed.npy', imu[::2])\n"
          "numpy.save('other.npy', imu['gyro'])\n");
  INFO(content(folder / "output.txt"));
  REQUIRE(good);
  check_same(read_npy_imu(folder / "again.npy"), written);
  CHECK(read_npy_imu(folder / "packed.npy").size() == 500);
  CHECK_THROWS_AS(read_npy_imu(folder / "other.npy"), std::runtime_error);
}
