// SPDX-License-Identifier: MIT
#include <cstdint>
#include <limits>
#include <splinertia/io/detail/little_endian.hpp>
#include <splinertia/io/detail/npy.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using test::content;
using test::error_of;

namespace {

constexpr const char* dtype = "[('n', '<i8')]";

std::string record(std::int64_t value) {
  std::string bytes(8, '\0');
  store_little_endian(bytes.data(), value);
  return bytes;
}

/// A file as NumPy's description of the format says, with a dict of ours.
std::string npy(std::string dict, std::string_view records, std::string_view version = {"\x01\x00", 2}) {
  dict += '\n';
  return "\x93NUMPY" + std::string(version) + static_cast<char>(dict.size() % 256) +
         static_cast<char>(dict.size() / 256) + dict + std::string(records);
}

std::vector<std::int64_t> read(const std::filesystem::path& path) {
  NpyReader file(path, dtype, 8);
  std::vector<std::int64_t> result;
  while (file.next()) result.push_back(load_little_endian<std::int64_t>(file.record()));
  return result;
}

std::vector<std::int64_t> read_bytes(std::string_view bytes) {
  const test::TemporaryDirectory folder;
  return read(folder.write("a.npy", bytes));
}

/// The message about a file of these bytes, without its path.
std::string error_in(std::string_view bytes) {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("bad.npy", bytes);
  const std::string error = error_of<std::runtime_error>([&] { (void)read(path); });
  REQUIRE(error.starts_with(path.string() + ": "));
  REQUIRE(error.find('\n') == std::string::npos);
  return error.substr(path.string().size() + 2);
}

std::string error_of_dict(const std::string& dict) { return error_in(npy(dict, record(7))); }

}  // namespace

TEST_CASE("the header is as NumPy describes it") {
  const std::string header = npy_header("'<f8'", 3);
  REQUIRE(header.size() == 128);
  CHECK(header.substr(0, 8) == std::string_view("\x93NUMPY\x01\x00", 8));
  CHECK(header.substr(8, 2) == std::string_view("\x76\x00", 2));  // 118 = 128 - 10
  const std::string dict = "{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }";
  CHECK(header.substr(10) == dict + std::string(117 - dict.size(), ' ') + "\n");
}

TEST_CASE("the header has the same size for every number of rows, a multiple of 64") {
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t length = 0; length < 300; ++length) {
    const std::string header = npy_header(std::string(length, 'x'), 0);
    REQUIRE(header.size() % 64 == 0);
    REQUIRE(header.size() == npy_header(std::string(length, 'x'), most).size());
    REQUIRE(header.size() == 10 + static_cast<unsigned char>(header[8]) + 256u * static_cast<unsigned char>(header[9]));
    REQUIRE(npy_header(std::string(length, 'x'), most).ends_with('\n'));
  }
}

TEST_CASE("records are read as they were written, beyond one block") {
  const test::TemporaryDirectory folder;
  for (const std::int64_t size : {1, 8191, 8192, 8193, 30'000}) {
    {
      NpyWriter file(folder / "a.npy", dtype);
      for (std::int64_t i = 0; i < size; ++i) file.advance(store_little_endian(file.room(8), 3 * i - 1));
      CHECK(folder.files() <= (size == 1 ? 1 : 2));  // hidden, where files without names are not to be had
      file.commit();
    }
    const auto numbers = read(folder / "a.npy");
    REQUIRE(numbers.size() == static_cast<std::size_t>(size));
    for (std::int64_t i = 0; i < size; ++i) REQUIRE(numbers[static_cast<std::size_t>(i)] == 3 * i - 1);
    CHECK(content(folder / "a.npy").starts_with(npy_header(dtype, static_cast<std::uint64_t>(size))));
  }
}

TEST_CASE("no rows, no file") {
  const test::TemporaryDirectory folder;
  const auto path = folder / "a.npy";
  CHECK(error_of<std::invalid_argument>([&] { NpyWriter(path, dtype).commit(); }) ==
        path.string() + ": no rows to write");
  CHECK(folder.files() == 0);
}

TEST_CASE("writers may put blanks, quotation marks, commas and keys as they like") {
  const std::vector<std::int64_t> seven{7};
  CHECK(read_bytes(npy("{'descr': [('n', '<i8')], 'fortran_order': False, 'shape': (1,), }", record(7))) == seven);
  CHECK(read_bytes(npy("{\"shape\":(1,),\"fortran_order\":False,\"descr\":[(\"n\",\"<i8\"),]}", record(7))) == seven);
  CHECK(read_bytes(npy(" { 'descr' : [ ( 'n' , '<i8' ) ] , 'shape' : ( 1 , ) , 'fortran_order' : False }   ",
                       record(7))) == seven);
}

TEST_CASE("plain literals keep what is quoted") {
  CHECK(plain_literal("[ 'a b,' , \"c'\" , ]\n") == "['a b,','c'']");
  CHECK(dict_entry("{'a':(1,),'b':{'c':2},'d':3}", "b") == "{'c':2}");
  CHECK(dict_entry("{'a':(1,),'b':{'c':2},'d':3}", "d") == "3");
  CHECK(dict_entry("{'a':(1,),'b':{'c':2},'d':3}", "c").empty());
  CHECK(dict_entry("", "c").empty());
  CHECK(dict_entry("'c':2", "c").empty());
}

TEST_CASE("what is no such file is refused with its place") {
  const std::string magic = ", expected an .npy file, which begins with \\x93NUMPY";
  CHECK(error_in("") == "byte 0: \"\"" + magic);
  CHECK(error_in("#time,wx\n") == "byte 0: \"#time,\"" + magic);
  const std::string good =
      npy("{'descr': [('n', '<i8')], 'fortran_order': False, 'shape': (2,)}", record(7) + record(8));
  CHECK(read_bytes(good) == std::vector<std::int64_t>{7, 8});
  CHECK(error_in(npy("{}", "", {"\x02\x00", 2})) == "byte 6: version 2.0 of the .npy format, expected 1.0");
  CHECK(error_in(npy("{}", "", {"\x01\xFF", 2})) == "byte 6: version 1.255 of the .npy format, expected 1.0");
  for (std::size_t size = 6; size < good.size() - 16; ++size) {
    REQUIRE(error_in(good.substr(0, size)) == "byte " + std::to_string(size) + ": the file ends in the header");
  }
  const std::size_t header = good.size() - 16;
  for (std::size_t size = header; size < good.size(); ++size) {
    REQUIRE(error_in(good.substr(0, size)) == "byte " + std::to_string(size) + ": the file ends in row " +
                                                  std::to_string((size - header) / 8) + ", expected 2 rows");
  }
  CHECK(error_in(good + "x") ==
        "byte " + std::to_string(good.size()) + ": more bytes after the last of 2 rows, expected the end of the file");
  // As many rows as memory cannot hold are not believed.
  CHECK(error_in(npy("{'descr': [('n', '<i8')], 'fortran_order': False, 'shape': (1000000000000000000,)}",
                     record(7))) == "byte 101: the file ends in row 1, expected 1000000000000000000 rows");
}

TEST_CASE("another kind of array is refused with what it is") {
  CHECK(error_of_dict("{'descr': '<f8', 'fortran_order': False, 'shape': (1,)}") ==
        "byte 10: descr is \"'<f8'\", expected [('n', '<i8')]");
  CHECK(error_of_dict("{'descr': [('n', '>i8')], 'fortran_order': False, 'shape': (1,)}") ==
        "byte 10: descr is \"[('n','>i8')]\", expected [('n', '<i8')]");
  CHECK(error_of_dict("{'descr': [('n', '<i8')], 'fortran_order': True, 'shape': (1,)}") ==
        "byte 10: fortran_order is \"True\", expected False");
  for (const std::string shape :
       {"()", "(0,)", "(-1,)", "(1,1)", "(1)", "1", "(,)", "(x,)", "(99999999999999999999,)"}) {
    CHECK(error_of_dict("{'descr': [('n', '<i8')], 'fortran_order': False, 'shape': " + shape + "}") ==
          "byte 10: shape is \"" + shape + "\", expected (rows,) with at least 1");
  }
  CHECK(error_of_dict("{'fortran_order': False, 'shape': (1,)}") == "byte 10: descr is \"\", expected [('n', '<i8')]");
  CHECK(error_of_dict("none") == "byte 10: descr is \"\", expected [('n', '<i8')]");
  CHECK(
      error_of_dict("{'descr':[('n','<i8')],'fortran_order':False,'shape':(1,),'more':1}") ==
      "byte 10: the header is \"{'descr':[('n','<i8')],'fortran_order':False,'shape':(1,),'more':1}\", expected a dict "
      "of descr, fortran_order and shape");
}
