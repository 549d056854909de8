// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bitset>
#include <string>
#include <string_view>
#include <vector>

/// What the thesis measured of its LMS 511 (2.4.3), as numbers of a model. Each effect acts only
/// where a scanner asks for it. Where the thesis shows a curve without numbers, the curve here has
/// its shape and the comment says what was chosen.
namespace velum::scene {

enum class Effect : std::uint8_t {
  material,      ///< spread and offset by material and colour (2.4.3.3, 2.4.3.4)
  distance,      ///< systematic error that grows with the distance (2.4.3.2)
  incidence,     ///< spread and losses beyond 70 degrees (2.4.3.5)
  angulation,    ///< error that depends on the beam's angle (2.4.3.6)
  light,         ///< sun into the scanner or through cloth (2.4.3.7)
  mixed_pixels,  ///< a spot on two surfaces gives a range in between (2.4.3.8)
  transparency,  ///< some pulses pass through cloth (2.4.3.3, figure 2.18)
  remission,     ///< dark and oblique surfaces are lost sooner than at 80 m (2.3.1)
  warm_up,       ///< the 0.7 mm of table 2.1's first hour
};
inline constexpr std::size_t kEffects = 9;

/// The effects that act.
class Effects {
 public:
  /// "none", "all", or names separated by commas. Throws Error (Fault::graph) on any other name.
  [[nodiscard]] static Effects named(std::string_view names);
  [[nodiscard]] bool has(Effect effect) const { return set_[static_cast<std::size_t>(effect)]; }
  Effects& with(Effect effect) {
    set_.set(static_cast<std::size_t>(effect));
    return *this;
  }
  bool operator==(const Effects&) const = default;

 private:
  std::bitset<kEffects> set_;
};

/// Mean error at a distance [m]: 3.4 mm and 1 mm a metre, at most 0.27 % of the distance. The
/// thesis says: almost linear in the distance, falling as a share of it, 0.27 % at most
/// (figure 2.15, from 2 m on). The slope is chosen; it keeps the data sheet's 12 mm at 6 m.
[[nodiscard]] double distance_error(double range);

/// Mean error of a beam at `angle` [m]: that of a mirror whose axis lies 3 mm off the frame's
/// origin, which the thesis suspects: too far from 0 to 60 degrees, too near from 90 to 180. The
/// 3 mm are chosen ("slightly", 2.4.3.6).
[[nodiscard]] double angulation_error(double angle);

/// What is added (in squares) to the spread [m] on a surface met at `incidence` [rad] with a spot
/// of `spot` [m]: nothing up to 70 degrees, then a tenth of how much deeper the spot reaches. The
/// share is chosen; that it grows with the angle and the distance is measured (figure 2.20).
[[nodiscard]] double incidence_spread(double incidence, double spot);
/// Share of pulses that never come back from there: 0 up to 70 degrees, a quarter at 80, all at 90
/// (chosen; the thesis lost points on the sail's head beyond 70 degrees).
[[nodiscard]] double incidence_loss(double incidence);

/// How the sun reaches a scanner.
enum class Sunlight : std::uint8_t { none, through_cloth, direct };
/// Factor on the spread of a beam that points `away` [rad] from the sun, whose glare is `width`
/// [rad] wide (one sigma): up to 4.5 in direct light (+350 %), 1.5 through cloth (+50 %).
[[nodiscard]] double glare(Sunlight sunlight, double away, double width);

/// Does the pulse come back? White matt surfaces are seen up to 80 m (2.3.1); light falls with the
/// square of the distance and the cosine of the incidence.
[[nodiscard]] double signal(double range, double incidence, double remission);
inline constexpr double kLeastSignal = 1.0 / (80.0 * 80.0);

/// Mean error `hours` after power-on [m]: 1.6 mm that decays within half an hour, which gives the
/// hourly means of table 2.1. (The thesis calls this no trend.)
[[nodiscard]] double warm_up_error(double hours);

}  // namespace velum::scene
