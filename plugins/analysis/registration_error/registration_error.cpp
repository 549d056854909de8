// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <numbers>
#include <velum/stage.hpp>

#include "geometry/motion.hpp"

namespace {

struct RegistrationError {
  velum::Place point;

  static auto about() {
    return velum::About<RegistrationError>("How far a transform is from the true one.")
        .in("transform")
        .in("reference", "the true transform between the same frames")
        .out("table", "one row")
        .param(&RegistrationError::point, "point",
               "a place in the source frame, where the translation is measured")
        .reference("Canciani thesis, 3.2.3, table 3.23")
        .deterministic();
  }

  velum::Table operator()(const velum::Transform& transform, const velum::Transform& reference,
                          velum::Context& context) const {
    context.check();
    const velum::Pose& found = transform.matrix;
    const velum::Pose& truth = reference.matrix;
    if (!found.matrix().allFinite() || !truth.matrix().allFinite())
      throw velum::Error(velum::Fault::stage, "a transform holds numbers that are not finite");
    const auto apart = velum::geometry::difference(found, truth, point.metres);
    const Eigen::Vector3d miss = found * point.metres - truth * point.metres;
    context.measure("rotation", apart.rotation, "rad", velum::Better::lower);
    context.measure("translation", apart.translation, "m", velum::Better::lower);
    velum::Table table(
        {{"rotation", "deg"}, {"translation", "mm"}, {"x", "mm"}, {"y", "mm"}, {"z", "mm"}});
    table.add({apart.rotation * 180.0 / std::numbers::pi, 1e3 * apart.translation, 1e3 * miss.x(),
               1e3 * miss.y(), 1e3 * miss.z()});
    return table;
  }
};

}  // namespace
VELUM_STAGE(RegistrationError)
