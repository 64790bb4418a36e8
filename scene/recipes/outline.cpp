// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/outline.h"

#include <algorithm>
#include <cmath>

#include "scene/recipes/placement.h"

namespace luciole::workshop {
namespace {

using Line = std::vector<Vec2>;

float distance(Vec2 a, Vec2 b) { return std::sqrt(dot(a - b, a - b)); }
Vec2 point(const Knot& knot) { return {knot.x, knot.y}; }
bool is_corner(const Knot& knot) { return knot.rounding >= 0; }

float line_length(const Line& line) {
  float sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += distance(line[i - 1], line[i]);
  return sum;
}

// Slopes of the curve per unit of chord, at each knot: the parabola through three neighbours.
Line slopes(const Line& knots, bool closed) {
  const std::size_t count = knots.size();
  Line result(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool inner = closed || (i > 0 && i + 1 < count);
    if (!inner) continue;
    const Vec2 before = knots[(i + count - 1) % count], here = knots[i], after = knots[(i + 1) % count];
    const float back = distance(before, here), ahead = distance(here, after);
    result[i] = ((after - here) * (back / ahead) + (here - before) * (ahead / back)) * (1 / (back + ahead));
  }
  if (closed) return result;
  const Vec2 first = (knots[1] - knots[0]) * (1 / distance(knots[0], knots[1]));
  const Vec2 last = (knots[count - 1] - knots[count - 2]) * (1 / distance(knots[count - 2], knots[count - 1]));
  result[0] = count > 2 ? first * 1.5f - result[1] * 0.5f : first;
  result[count - 1] = count > 2 ? last * 1.5f - result[count - 2] * 0.5f : last;
  return result;
}

// The cubic curve through all knots, sampled; open lines end with the last knot, closed ones before the first.
Line smooth_curve(const Line& knots, bool closed, float samples_per_metre) {
  if (knots.size() == 2) return knots;
  const Line slope = slopes(knots, closed);
  Line line;
  const std::size_t spans = closed ? knots.size() : knots.size() - 1;
  for (std::size_t i = 0; i < spans; ++i) {
    const std::size_t next = (i + 1) % knots.size();
    const float chord = distance(knots[i], knots[next]);
    const int steps = std::max(1, static_cast<int>(std::lround(chord * samples_per_metre)));
    for (int k = 0; k < steps; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(steps), s = 1 - t;
      line.push_back(knots[i] * (s * s * (1 + 2 * t)) + slope[i] * (chord * t * s * s) +
                     knots[next] * (t * t * (3 - 2 * t)) - slope[next] * (chord * t * t * s));
    }
  }
  if (!closed) line.push_back(knots.back());
  return line;
}

// Cuts `amount` of length off the line's front.
Line trimmed_front(Line line, float amount) {
  std::size_t first = 0;
  while (first + 2 < line.size() && distance(line[first], line[first + 1]) <= amount) {
    amount -= distance(line[first], line[first + 1]);
    ++first;
  }
  const float step = distance(line[first], line[first + 1]);
  if (step > 0) line[first] = line[first] + (line[first + 1] - line[first]) * std::min(amount / step, 0.9f);
  // What is left of a cut segment may be so short that a bevel would turn it round: the next point goes.
  if (amount > 0.4f * step && first + 2 < line.size())
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(first + 1));
  line.erase(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(first));
  return line;
}

Line trimmed(Line line, float front, float back) {
  const float most = 0.45f * line_length(line);
  line = trimmed_front(std::move(line), std::min(front, most));
  std::reverse(line.begin(), line.end());
  line = trimmed_front(std::move(line), std::min(back, most));
  std::reverse(line.begin(), line.end());
  return line;
}

// Two inner points of the arc that rounds off a corner between the ends of two trimmed lines.
void add_arc(Line& line, Vec2 from, Vec2 corner, Vec2 to) {
  for (const float t : {0.33f, 0.67f}) {
    const float s = 1 - t;
    line.push_back(from * (s * s) + corner * (2 * s * t) + to * (t * t));
  }
}

// Runs from corner to corner: knots[ends[k]] .. knots[ends[k + 1]], each trimmed to make room for the rounding.
std::vector<Line> corner_runs(const std::vector<Knot>& knots, std::uint32_t samples, bool closed) {
  float chords = 0;
  for (std::size_t i = 1; i < knots.size(); ++i) chords += distance(point(knots[i - 1]), point(knots[i]));
  std::vector<Line> runs;
  for (std::size_t begin = 0; begin + 1 < knots.size();) {
    std::size_t end = begin + 1;
    while (end + 1 < knots.size() && !is_corner(knots[end])) ++end;
    Line through;
    for (std::size_t i = begin; i <= end; ++i) through.push_back(point(knots[i]));
    const bool round_front = closed || begin > 0, round_back = closed || end + 1 < knots.size();
    runs.push_back(trimmed(smooth_curve(through, false, static_cast<float>(samples) / chords),
                           round_front ? std::max(knots[begin].rounding, 0.0f) : 0.0f,
                           round_back ? std::max(knots[end].rounding, 0.0f) : 0.0f));
    begin = end;
  }
  return runs;
}

// Joins runs, with an arc where two meet at the corner knot between them.
Line joined(const std::vector<Line>& runs, const std::vector<Vec2>& corners) {
  Line line;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (k > 0) add_arc(line, line.back(), corners[k - 1], runs[k].front());
    line.insert(line.end(), runs[k].begin(), runs[k].end());
  }
  // A corner without rounding leaves doubled points.
  line.erase(std::unique(line.begin(), line.end(), [](Vec2 a, Vec2 b) { return distance(a, b) < 1e-6f; }), line.end());
  return line;
}

std::vector<Vec2> inner_corners(const std::vector<Knot>& knots) {
  std::vector<Vec2> corners;
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    if (is_corner(knots[i])) corners.push_back(point(knots[i]));
  }
  return corners;
}

}  // namespace

std::vector<Vec2> open_line(const std::vector<Knot>& knots, std::uint32_t samples) {
  return joined(corner_runs(knots, samples, false), inner_corners(knots));
}

std::vector<Vec2> closed_line(std::vector<Knot> knots, std::uint32_t samples) {
  const auto corner = std::find_if(knots.begin(), knots.end(), is_corner);
  if (corner == knots.end()) {
    Line through;
    float chords = distance(point(knots.back()), point(knots.front()));
    for (const Knot& knot : knots) through.push_back(point(knot));
    for (std::size_t i = 1; i < through.size(); ++i) chords += distance(through[i - 1], through[i]);
    return smooth_curve(through, true, static_cast<float>(samples) / chords);
  }
  std::rotate(knots.begin(), corner, knots.end());
  knots.push_back(knots.front());
  Line line = joined(corner_runs(knots, samples, true), inner_corners(knots));
  add_arc(line, line.back(), point(knots.front()), line.front());
  return line;
}

std::vector<Vec2> circle(float radius, std::uint32_t samples) {
  Line line;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const float angle = kTwoPi * static_cast<float>(i) / static_cast<float>(samples);
    line.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return line;
}

std::vector<Vec2> rounded_rectangle(Vec2 size, float rounding) {
  const float x = size.x / 2, y = size.y / 2;
  return closed_line({{-x, -y, rounding}, {x, -y, rounding}, {x, y, rounding}, {-x, y, rounding}}, 4);
}

std::vector<Vec2> moved_outwards(const std::vector<Vec2>& loop, float by) {
  const std::size_t count = loop.size();
  Line result(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 in = loop[i] - loop[(i + count - 1) % count], out = loop[(i + 1) % count] - loop[i];
    const Vec2 a = Vec2{in.y, -in.x} * (1 / std::sqrt(dot(in, in)));
    const Vec2 b = Vec2{out.y, -out.x} * (1 / std::sqrt(dot(out, out)));
    // The mitre: both edges move by `by`. Sharp turns are cut at twice that.
    result[i] = loop[i] + (a + b) * (by / std::max(1 + dot(a, b), 0.5f));
  }
  return result;
}

}  // namespace luciole::workshop
