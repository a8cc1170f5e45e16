// SPDX-License-Identifier: MIT
// Whether what is composed from the library takes more instructions than the same written by hand: one pair of
// functions for each point at which things are composed, derivative, group, measurement, integrator and turning world
// (that of error terms is in error_models.cpp).
//
// NAME is composed from the library; NAME_by_hand is the same formula on plain numbers, vectors and quaternions, as
// people write it: with none of the library's types that compose (no Spline, Motion, GroupTraits, Product, scheme,
// window or Frame) and no attributes for the compiler. Of the library it takes the leaves: exp and its coefficients,
// quaternion times quaternion and times vector. NAME_inlined is NAME_by_hand with every call in it inlined
// (gnu::flatten), which shows how much of a difference is where a compiler stops inlining; it is listed, and not a
// limit.

#include "support/overhead.hpp"
#include "overhead/curve_pairs.hpp"
#include "overhead/differences.hpp"
#include "overhead/integration_pairs.hpp"
#include "overhead/workload.hpp"

namespace {

/// Calls f(data, t, result) at random times.
template <typename Data, typename Result>
benchmark::Kernel at_random_times(const std::string& name, const Data& data, Result (*f)(const Data&, double)) {
  return {name, [&data, f](std::size_t calls) {
            const auto& times = workload().times;
            for (std::size_t i = 0; i < calls; ++i) benchmark::keep(f(data, times[i % times.size()]));
          }};
}

// What the library may have more. A loop of its own that integrates takes readings one at a time from any range, and
// keeps those that a scheme looks at and how far it has come; by hand they are in an array: a few stores a reading.
#ifdef __clang__
// clang++-14 takes gnu::flatten for one level of calls only: below it, what a function of the library hands to the next
// goes through memory, where a few larger functions by hand have it in registers.
constexpr benchmark::Tolerance of_curves{.part = 0.3}, of_integration{.part = 0.3};
#else
constexpr benchmark::Tolerance of_curves{}, of_integration{.part = 0.05};
#endif

/// by_hand with every call in it inlined.
template <auto by_hand, typename... Arguments>
[[gnu::noinline, gnu::flatten]] auto inlined(Arguments... arguments) {
  return by_hand(arguments...);
}

template <auto by_hand, typename Data, typename Result, typename PlainData>
benchmark::Pair pair(const std::string& name, const Data& data, Result (*library)(const Data&, double),
                     const PlainData& plain) {
  return {at_random_times(name, data, library), at_random_times(name + "_by_hand", plain, by_hand),
          [=, &data, &plain] {
            Differences differences;
            for (const double t : workload().times) differences(library(data, t), by_hand(plain, t));
            return differences.largest;
          },
          at_random_times(name + "_inlined", plain, &inlined<by_hand, const PlainData&, double>), of_curves};
}

/// Runs f over the readings again and again; a call is a reading.
template <typename State>
benchmark::Kernel over_readings(const std::string& name, const Flight<State>& flight,
                                std::vector<State> (*f)(const Flight<State>&)) {
  return {name, [&flight, f](std::size_t calls) {
            for (std::size_t n; calls >= 4; calls -= n) {  // the least that Magnus4 asks for
              n = std::min(calls, flight.readings.size());
              Flight<State> part = flight;
              part.readings = flight.readings.first(n);
              benchmark::keep(f(part));
            }
          }};
}

template <auto by_hand>
benchmark::Pair pair(const std::string& name, States (*library)(const LibraryFlight&)) {
  static const Vector earth(0, 4.6e-5, 5.6e-5);
  static const LibraryFlight flight{
      {SO3(), Vector(1, 2, 3), Vector::Zero(), 0.0}, standard_gravity<double>(), earth, workload().readings};
  static const PlainFlight plain{
      {Quaternion::Identity(), Vector(1, 2, 3), Vector::Zero(), 0.0}, flight.gravity, earth, workload().readings};
  return {over_readings(name, flight, library), over_readings<PlainState>(name + "_by_hand", plain, by_hand),
          [=] {
            Differences differences;
            differences(library(flight), by_hand(plain));
            return differences.largest;
          },
          over_readings<PlainState>(name + "_inlined", plain, &inlined<by_hand, const PlainFlight&>), of_integration};
}

const std::vector<benchmark::Pair>& pairs() {
  static const PlainRotations rotations = plain_rotations();
  static const PlainPositions positions{plain_knots, curve<Vector>().control_points(), curve<Vector>().increments()};
  static const PlainPlanar planar = plain_planar();
  static const PlainPoses split = plain_poses<Split>(), rigid = plain_poses<SE3>();
  static const auto split_imu = mounted<Split>();
  static const auto rigid_imu = mounted<SE3>();
  static const PlainMounted plain_split_imu = plain_mounted<Split>(), plain_rigid_imu = plain_mounted<SE3>();
  static const std::vector<benchmark::Pair> the{
      pair<so3_evaluate0_by_hand>("so3_evaluate0", curve<SO3>(), so3_evaluate0, rotations),
      pair<so3_evaluate1_by_hand>("so3_evaluate1", curve<SO3>(), so3_evaluate1, rotations),
      pair<so3_evaluate2_by_hand>("so3_evaluate2", curve<SO3>(), so3_evaluate2, rotations),
      pair<so3_evaluate3_by_hand>("so3_evaluate3", curve<SO3>(), so3_evaluate3, rotations),
      pair<so3xr3_evaluate2_by_hand>("so3xr3_evaluate2", curve<Split>(), so3xr3_evaluate2, split),
      pair<r3_evaluate1_by_hand>("r3_evaluate1", curve<Vector>(), r3_evaluate1, positions),
      pair<se2_evaluate1_by_hand>("se2_evaluate1", curve<Sophus::SE2d>(), se2_evaluate1, planar),
      pair<so3xr3_evaluate1_by_hand>("so3xr3_evaluate1", curve<Split>(), so3xr3_evaluate1, split),
      pair<se3_evaluate1_by_hand>("se3_evaluate1", curve<SE3>(), se3_evaluate1, rigid),
      pair<so3xr3_imu_by_hand>("so3xr3_imu", split_imu, so3xr3_imu, plain_split_imu),
      pair<so3xr3_imu_lever_arm_by_hand>("so3xr3_imu_lever_arm", split_imu, so3xr3_imu_lever_arm, plain_split_imu),
      pair<se3_imu_by_hand>("se3_imu", rigid_imu, se3_imu, plain_rigid_imu),
      pair<se3_imu_lever_arm_by_hand>("se3_imu_lever_arm", rigid_imu, se3_imu_lever_arm, plain_rigid_imu),
      pair<integrate_euler_by_hand>("integrate_euler", integrate_euler),
      pair<integrate_midpoint_by_hand>("integrate_midpoint", integrate_midpoint),
      pair<integrate_runge_kutta4_by_hand>("integrate_runge_kutta4", integrate_runge_kutta4),
      pair<integrate_magnus4_by_hand>("integrate_magnus4", integrate_magnus4),
      pair<integrate_euler_earth_by_hand>("integrate_euler_earth", integrate_euler_earth),
      pair<integrate_midpoint_earth_by_hand>("integrate_midpoint_earth", integrate_midpoint_earth),
      pair<integrate_runge_kutta4_earth_by_hand>("integrate_runge_kutta4_earth", integrate_runge_kutta4_earth),
      pair<integrate_magnus4_earth_by_hand>("integrate_magnus4_earth", integrate_magnus4_earth),
  };
  return the;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::OverheadOptions overhead{.inlined = "inlined"};
  return benchmark::run(
      argc, argv, "Composed from the library, and written by hand.", benchmark::kernels_of(pairs()),
      {.options = [&](CLI::App& app) { overhead.add(app); }, .instead = [&] { return overhead.run(pairs(), "call"); }});
}
