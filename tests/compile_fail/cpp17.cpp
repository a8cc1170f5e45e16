// expect: #error splinertia needs C\+\+20
// flags: -std=c++17
#include <splinertia/splinertia.hpp>
