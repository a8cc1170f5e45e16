// SPDX-License-Identifier: MIT
// Any bytes as a camchain.yaml and as a sensor.yaml. What is read is written in all formats, and read again.
#include "support/camera_file.hpp"

#include <splinertia/camera/any_camera_model.hpp>
#include <string>
#include <variant>

#include "fuzz/files.hpp"

namespace splinertia::fuzz::camera_file_target {

/// The model accepts any pixel and point, and gives numbers or nothing.
void expect_model(const KalibrCamera& camera) {
  std::visit(
      [](const auto& model) {
        for (const double x : {0.0, 1e-200, 0.7, 1e3, -1e200}) {
          const auto pixel = model.project({x, 0.3, 1});
          expect(!pixel || pixel->allFinite(), "a pixel that is not finite");
          const auto ray = model.unproject({x, 0.3});
          expect(!ray || ray->allFinite(), "a ray that is not finite");
        }
      },
      any_camera_model(camera));
}

void expect_other_formats(const KalibrCamera& camera) {
  (void)accepted("OpenCV has no model ", [&] { (void)opencv_camera_text(camera); });
  (void)accepted("COLMAP has no model ", [&] { (void)colmap_camera_line(camera); });
}

const Target target{"camera_file", [](Input input) {
                      static InputBytes file("camera.yaml"), copy("copy.yaml");
                      const std::string& path = file.with(input.rest());
                      std::vector<KalibrCamera> cameras;
                      if (accepted(path, [&] { cameras = read_camchain(path); })) {
                        for (KalibrCamera& camera : cameras) {
                          camera.rostopic.clear();  // bytes that are no UTF-8 are written as escapes
                          expect_model(camera);
                          expect_other_formats(camera);
                        }
                        const std::string text = camchain_text(cameras);
                        expect(camchain_text(read_camchain(copy.with(text))) == text, "it has changed");
                      }
                      EurocCamera euroc;
                      if (!accepted(path, [&] { euroc = read_euroc_camera(path); })) return;
                      expect_model(euroc.camera);
                      const EurocCamera again = read_euroc_camera(copy.with(euroc_camera_text(euroc)));
                      expect(again.camera.intrinsics == euroc.camera.intrinsics && again.rate == euroc.rate,
                             "it has changed");
                    }};

}  // namespace splinertia::fuzz::camera_file_target
