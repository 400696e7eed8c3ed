#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/sighting.h"

// The ring marker: what it looks like, said once. `relock marker` prints it, the simulator shows it and the
// ring detectors read it from the functions below.
//
//     rho = r/R:   0     .18   .33   .41   .55   .63   .77  .855    1        quiet  quiet + border
//                  |black |white|black|white|black|white|black|white | black   |~~~~~~| white paper
//                        always      bit '·1'    bit '1·'    always   quiet zone  soft
//
// Concentric white rings on a round black sheet. The innermost and the outermost ring are always there; each
// ring between them is one bit: there (1) or not (0). The last character of the bits is the ring nearest to
// the middle: of "01" the ring at .41 to .55 is there, the one at .63 to .77 is not.
//
// Whatever the direction of a motion blur, a line through the middle along it keeps the pattern of the rings
// for the longest, and a motion across it leaves them where they are.
//
// R is the outer radius of the outermost ring. A marker's size is its diameter 2R, in metres where it has a
// unit; every length here is a part of R.

namespace relock {

/// What lies between two circles about the middle, parts of R.
struct Annulus {
  double inner = 0;
  double outer = 1;
  double width() const { return outer - inner; }
  friend bool operator==(const Annulus&, const Annulus&) = default;
};

/// Where rings can be, whatever the code.
struct RingGeometry {
  /// Innermost first. The first and the last are always white rings, those between are the bits.
  std::vector<Annulus> slots;
  /// Radius up to which the sheet is black. From 1.3 on, the window along a blur of up to 0.87 diameters still
  /// begins and ends on black; that matters more than where the rings are.
  double quiet_zone = 1.3;
  /// Width of the passage from black to white paper beyond the quiet zone, a half wave of a cosine, so that
  /// the sheet has no sharp edge of its own. With 0.04 a marker of 150 mm fits on A4.
  double soft_border = 0.04;
  /// Black rings on white: 1 - reflectance up to the quiet zone's radius, and nothing to soften beyond it.
  bool inverted = false;

  int bits() const { return static_cast<int>(slots.size()) - 2; }
  /// All that is printed lies within this radius.
  double sheet_radius() const { return inverted ? quiet_zone : quiet_zone + soft_border; }
  friend bool operator==(const RingGeometry&, const RingGeometry&) = default;
};

constexpr int kMostRingBits = 6;

/// Two bits, with the radii measured on the real prints of the marker's authors, see above: rings of .14 to
/// .15, gaps of .08 (their sheets are black farther out than ours).
RingGeometry paper_ring_geometry();
/// Rings, gaps and the hole in the middle all equally wide: u = R / (2 bits + 4). At the same size this reads
/// as well as any under blur: a larger hole makes rings thinner, which costs more than it gains.
RingGeometry even_ring_geometry(int bits);

/// The slots that `text` says, for codes of so many bits, with default quiet zone and border:
/// - "paper": paper_ring_geometry for two bits; their authors printed no others, for which it is "even";
/// - "even": even_ring_geometry;
/// - radii, innermost ring first: "0.18-0.33,0.41-0.55,0.855-1" is one bit (/ may stand for a comma).
/// Throws Error unless the radii rise from 0 or more to exactly 1 and there are bits + 2 rings, and when there
/// are no such bits (1 to kMostRingBits).
RingGeometry ring_geometry(std::string_view text, int bits);

/// What ring_geometry() would be asked for: "paper", "even" or the radii.
std::string slots_text(const RingGeometry& geometry);

/// Whether no ring differs from the mean width by more than a tenth. A reader that is told only the number of
/// bits cannot know of rings that do.
bool equally_wide(const RingGeometry& geometry);

/// Throws Error that names what is wrong with it: slots as ring_geometry() says, quiet_zone from 1 to 4,
/// soft_border from 0 to 2.
void check(const RingGeometry& geometry);

/// What the sheet is printed in; the rings are white on all of them. The colours are saturated and dark: to a camera that
/// sees grey they are nearly as good as black (docs/ring.md).
enum class SheetColour : std::uint8_t { black, red, green, blue };
constexpr int kSheetColours = 4;
std::string_view to_string(SheetColour colour);

/// How much red, green and blue light something throws back: 0 none, 1 as white paper.
struct Reflected {
  double red = 0, green = 0, blue = 0;
  /// What of it is seen in grey (Rec. 709).
  double grey() const { return 0.2126 * red + 0.7152 * green + 0.0722 * blue; }
};
Reflected reflected_by(SheetColour colour);
/// The colour that is nearest to what was seen.
SheetColour nearest_sheet_colour(const Reflected& seen);

/// One marker.
struct RingMarker {
  RingGeometry geometry;
  std::string bits;  ///< '0' and '1', as many as the geometry has; the last one is nearest to the middle
  SheetColour sheet = SheetColour::black;  ///< black where the marker is inverted
  friend bool operator==(const RingMarker&, const RingMarker&) = default;
};

/// Throws Error when `bits` are not one to kMostRingBits characters 0 and 1.
void check_ring_bits(std::string_view bits);
/// All codes of so many bits, in the order of the numbers they are: "00", "01", "10", "11".
std::vector<std::string> all_ring_bits(int bits);

/// "ring2" for two bits: the family of their codes.
std::string ring_family(int bits);
/// What a reader should read on it: {"ring2", "01"}, on a coloured sheet {"ring2", "01-red"}.
Code code_of(const RingMarker& marker);
/// The value of such a code taken apart: "01-red". Throws Error when it is none.
struct RingValue {
  std::string bits;
  SheetColour sheet = SheetColour::black;
};
RingValue parse_ring_value(std::string_view value);
std::string to_string(const RingValue& value);

/// The rings that this marker has, innermost first.
std::vector<Annulus> rings_of(const RingMarker& marker);

/// How much light the ideal print throws back at the radius rho = r/R: 0 the sheet, 1 white, linear in light. Beyond the
/// sheet there is white paper.
double reflectance(const RingMarker& marker, double rho);

}  // namespace relock
