#include "utd/surface/strip_arrivals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/filon.h"

namespace raytube {

namespace {

// Between strips that arrive at wedges far apart there are others, down to this part of a piece of the shadow boundary.
constexpr double least_part = 1.0 / 64.0;

class LineIntegral {
 public:
  LineIntegral(const BoundaryLine& line, std::span<const double> wavenumbers, double wavelength, const StripOfPiece& strip_of)
      : line_(line), wavenumbers_(wavenumbers), wavelength_(wavelength), strip_of_(strip_of) {}

  // Adds the strips of all pieces of a line_. What of them arrives at wedges is integrated along the line: where strips graze the
  // wedge their ends are far apart there, and phases turn by more than one piece stands for.
  void add_all() {
    std::vector<std::optional<ArrivingStrip>> arrivals;
    const std::vector<BoundaryPiece> pieces = line_.pieces();
    for (const BoundaryPiece& piece : pieces) arrivals.push_back(strip_of_(piece, true));
    if (pieces.empty() || std::ranges::none_of(arrivals, [](const auto& arrival) { return arrival.has_value(); })) return;
    if (line_.closed() && pieces.size() > 1) {
      const auto middle = [](const BoundaryPiece& piece) { return 0.5 * (piece.from + piece.to); };
      for (std::size_t i = 0; i + 1 < pieces.size(); ++i)
        integrate(middle(pieces[i]), middle(pieces[i + 1]), arrivals[i], arrivals[i + 1]);
      if (arrivals.front()) arrivals.front()->at += line_.length();
      integrate(middle(pieces.back()), middle(pieces.front()) + line_.measure(), arrivals.back(), arrivals.front());
    } else {
      double last = 0.0;
      std::optional<ArrivingStrip> before = strip_at(0.0);
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double middle = 0.5 * (pieces[i].from + pieces[i].to);
        integrate(last, middle, i == 0 ? before : arrivals[i - 1], arrivals[i]);
        last = middle;
      }
      std::optional<ArrivingStrip> after = strip_at(line_.measure());
      integrate(last, line_.measure(), arrivals.back(), after);
      put(before), put(after);
    }
    for (std::optional<ArrivingStrip>& arrival : arrivals) put(arrival);
  }

  std::vector<SurfaceArrival> take() { return std::move(arrivals_); }

 private:
  // How far from one another strips arrive [m].
  static double distance(const std::optional<ArrivingStrip>& a, const std::optional<ArrivingStrip>& b) {
    return a && b ? glm::distance(a->arrival.position, b->arrival.position) : std::numeric_limits<double>::infinity();
  }

  // Integrates from the strip of one place on a line to that of another. Where they arrive farther apart than a sixth of a
  // wavelength, each half of the stretch is integrated by itself. Ends that two halves in a row, `jumps`, have not brought nearer
  // by a quarter stand on different edges.
  void integrate(double from, double to, std::optional<ArrivingStrip>& a, std::optional<ArrivingStrip>& b, int jumps = 0) {
    if (!a && !b) return;
    const double apart = distance(a, b);
    if (apart <= 1.0 / 6.0 * wavelength_) return add_between(*a, *b);
    if (to - from > least_part && jumps < 2) {
      const double middle = 0.5 * (from + to);
      std::optional<ArrivingStrip> between = strip_at(middle);
      const auto jumps_to = [&](double nearer) { return nearer < 0.75 * apart ? 0 : jumps + 1; };
      integrate(from, middle, a, between, jumps_to(distance(a, between)));
      integrate(middle, to, between, b, jumps_to(distance(between, b)));
      return put(between);
    }
    // They end on different lines of edges, or one of them on none.
    const double half = 0.5 * (line_.arc_length(to) - line_.arc_length(from));
    for (std::optional<ArrivingStrip>* one : {&a, &b})
      for (std::size_t f = 0; *one && f < wavenumbers_.size(); ++f)
        (*one)->weight[f] += std::polar(half, wavenumbers_[f] * (*one)->arrival.path);
  }

  // Amplitudes and phases linear from one to the other.
  void add_between(ArrivingStrip& a, ArrivingStrip& b) const {
    const double length = b.at - a.at;
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const double k = wavenumbers_[f];
      const FilonStep filon = filon_step(k * a.arrival.path, k * b.arrival.path, std::polar(1.0, k * a.arrival.path),
                                         std::polar(1.0, k * b.arrival.path));
      a.weight[f] += length * (filon.even - filon.odd);
      b.weight[f] += length * (filon.even + filon.odd);
    }
  }

  void put(std::optional<ArrivingStrip>& strip) {
    if (!strip) return;
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const Complex current = strip->current[f] * strip->weight[f];
      strip->arrival.magnetic.push_back({current * strip->magnetic[0], current * strip->magnetic[1]});
    }
    arrivals_.push_back(std::move(strip->arrival));
  }

  // At a place on a line, of a small part of a piece there, for what arrives at wedges alone.
  std::optional<ArrivingStrip> strip_at(double at) {
    const double half = 0.5 * least_part;
    const double all = line_.measure(), from_end = std::min(half, 0.5 * all);
    const double middle = line_.closed() ? at : std::clamp(at, from_end, all - from_end);
    std::optional<ArrivingStrip> strip = strip_of_(line_.piece(middle - half, middle + half), false);
    if (strip) strip->at = line_.arc_length(at);
    return strip;
  }

  const BoundaryLine& line_;
  std::span<const double> wavenumbers_;
  double wavelength_;
  const StripOfPiece& strip_of_;
  std::vector<SurfaceArrival> arrivals_;
};

}  // namespace

std::vector<SurfaceArrival> arrivals_along(const BoundaryLine& line, std::span<const double> wavenumbers, double wavelength,
                                           const StripOfPiece& strip_of) {
  LineIntegral integral(line, wavenumbers, wavelength, strip_of);
  integral.add_all();
  return integral.take();
}

}  // namespace raytube
