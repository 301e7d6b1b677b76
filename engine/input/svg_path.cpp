#include "input/svg_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace drape::input {

namespace {

using Point = std::array<double, 2>;
constexpr std::size_t most_points = 20'000;

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1]}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1]}; }
Point operator*(double s, const Point& a) { return {s * a[0], s * a[1]}; }
double length(const Point& a) { return std::hypot(a[0], a[1]); }

class PathReader {
  public:
    PathReader(std::string_view text, double tolerance) : text_(text), tolerance_(tolerance) {}
    std::vector<PathCurve> read();

  private:
    [[noreturn]] void fail(const std::string& expected) const {
        throw std::invalid_argument(fmt::format("{} at character {} of the path", expected, place_ + 1));
    }
    void skip_blanks();
    bool is_at_number();
    double number();
    bool flag();
    Point point();
    /// Returns a point that a small letter gives relative to where the pen is.
    Point target() {
        const Point given = point();
        return relative_ ? pen_ + given : given;
    }
    void draw(char command);
    void move();
    void line_to(const Point& to);
    void cubic_to(const Point& first, const Point& second, const Point& to);
    void arc_to();
    void trace_arc(Point radii, double turn, bool large, bool sweep, const Point& to);
    void close();
    void add(const Point& point);

    std::string_view text_;
    double tolerance_;
    std::size_t place_ = 0, count_ = 0;
    bool relative_ = false;
    char before_ = 0;         ///< the command before, as a capital: S and T go on from its curve alone
    Point pen_{}, handle_{};  ///< where the pen is; the last handle of the curve before
    std::vector<PathCurve> curves_;
    std::vector<Point> open_;  ///< the curve that is being drawn
};

void PathReader::skip_blanks() {
    while (place_ < text_.size() && std::string_view(" \t\r\n\f,").find(text_[place_]) != std::string_view::npos)
        ++place_;
}

bool PathReader::is_at_number() {
    skip_blanks();
    return place_ < text_.size() && std::string_view("+-.0123456789").find(text_[place_]) != std::string_view::npos;
}

double PathReader::number() {
    if (!is_at_number()) fail("a number");
    const std::size_t first = place_ + (text_[place_] == '+' ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + first, text_.data() + text_.size(), value);
    if (error != std::errc() || !(std::abs(value) <= 1e9)) fail("a number of at most 1e9");
    place_ = static_cast<std::size_t>(end - text_.data());
    return value;
}

/// The flags of an arc may stand without blanks between them.
bool PathReader::flag() {
    skip_blanks();
    if (place_ >= text_.size() || (text_[place_] != '0' && text_[place_] != '1')) fail("a flag, 0 or 1");
    return text_[place_++] == '1';
}

Point PathReader::point() {
    const double x = number();
    return {x, number()};
}

void PathReader::add(const Point& to) {
    if (++count_ > most_points) fail(fmt::format("curves of at most {} pieces", most_points));
    if (open_.empty() || open_.back() != to) open_.push_back(to);
    pen_ = to;
}

void PathReader::move() {
    const Point to = target();
    close();
    open_.push_back(pen_ = to);
}

void PathReader::line_to(const Point& to) { add(to); }

/// Draws a cubic Bezier curve in pieces: with n of them the way off the curve is at most h^2/8 of its second
/// derivative, h = 1/n.
void PathReader::cubic_to(const Point& first, const Point& second, const Point& to) {
    const Point from = pen_;
    const double bend = 6 * std::max(length(from - 2 * first + second), length(first - 2 * second + to));
    const double pieces = std::clamp(std::ceil(std::sqrt(bend / (8 * tolerance_))), 1.0, most_points + 1.0);
    for (double i = 1; i < pieces; ++i) {
        const double t = i / pieces, s = 1 - t;
        add(s * s * s * from + 3 * s * s * t * first + 3 * s * t * t * second + t * t * t * to);
    }
    add(to);
    handle_ = second;
}

void PathReader::arc_to() {
    const double rx = std::abs(number()), ry = std::abs(number());
    const double turn = number() * std::numbers::pi / 180;
    const bool large = flag(), sweep = flag();
    const Point to = target();
    if (to == pen_) return;
    if (rx == 0 || ry == 0) return line_to(to);
    trace_arc({rx, ry}, turn, large, sweep, to);
}

/// Follows SVG 1.1, F.6.5: from both ends to the centre and the angles, in the frame in which the ellipse is a circle.
void PathReader::trace_arc(Point radii, double turn, bool large, bool sweep, const Point& to) {
    const double c = std::cos(turn), s = std::sin(turn);
    const auto into_circle = [&](const Point& p) {
        return Point{(c * p[0] + s * p[1]) / radii[0], (c * p[1] - s * p[0]) / radii[1]};
    };
    const double gap = length(into_circle(0.5 * (pen_ - to)));
    if (gap > 1) radii = gap * radii;  // too small to reach: the least ellipse that does
    const Point from = into_circle(pen_), end = into_circle(to), half = 0.5 * (from - end);
    const double squared = half[0] * half[0] + half[1] * half[1];
    const double off = (large != sweep ? 1 : -1) * std::sqrt(std::max(0.0, (1 - squared) / squared));
    const Point centre = 0.5 * (from + end) + off * Point{half[1], -half[0]};
    const double begin = std::atan2(from[1] - centre[1], from[0] - centre[0]);
    double angle = std::atan2(end[1] - centre[1], end[0] - centre[0]) - begin;
    if (sweep && angle < 0) angle += 2 * std::numbers::pi;
    if (!sweep && angle > 0) angle -= 2 * std::numbers::pi;
    // A piece over the angle a is off by r (1 - cos(a/2)), about r a^2/8.
    const double step = std::sqrt(8 * tolerance_ / std::max(radii[0], radii[1]));
    const double pieces = std::clamp(std::ceil(std::abs(angle) / step), 1.0, most_points + 1.0);
    for (double i = 1; i < pieces; ++i) {
        const double at = begin + angle * i / pieces;
        const double x = radii[0] * (centre[0] + std::cos(at)), y = radii[1] * (centre[1] + std::sin(at));
        add({c * x - s * y, s * x + c * y});
    }
    add(to);
}

void PathReader::close() {
    if (open_.empty()) return;
    pen_ = open_.front();
    while (open_.size() > 1 && open_.back() == open_.front()) open_.pop_back();
    if (open_.size() > 2) curves_.push_back({std::move(open_), {}});
    open_.clear();
}

void PathReader::draw(char command) {
    const auto mirrored = [this](std::string_view after) {
        return after.find(before_) != std::string_view::npos && before_ != 0 ? 2 * pen_ - handle_ : pen_;
    };
    // A quadratic curve is the cubic one whose handles are two thirds of the way to its own.
    const auto quadratic_to = [this](const Point& handle, const Point& to) {
        cubic_to(pen_ + 2.0 / 3 * (handle - pen_), to + 2.0 / 3 * (handle - to), to);
        handle_ = handle;
    };
    if (command != 'M' && open_.empty()) open_.push_back(pen_);  // after Z the next curve begins where that one did
    switch (command) {
        case 'M':
            move();
            break;
        case 'L':
            line_to(target());
            break;
        case 'H':
            line_to({number() + (relative_ ? pen_[0] : 0), pen_[1]});
            break;
        case 'V':
            line_to({pen_[0], number() + (relative_ ? pen_[1] : 0)});
            break;
        case 'C': {
            const Point first = target(), second = target();
            cubic_to(first, second, target());
            break;
        }
        case 'S': {
            const Point first = mirrored("CS"), second = target();
            cubic_to(first, second, target());
            break;
        }
        case 'Q': {
            const Point handle = target();
            quadratic_to(handle, target());
            break;
        }
        case 'T':
            quadratic_to(mirrored("QT"), target());
            break;
        case 'A':
            arc_to();
            break;
        default:
            fail("one of the commands M, L, H, V, C, S, Q, T, A and Z");
    }
    before_ = command;
}

/// Marks where a closed curve turns by more than 20 degrees from one piece to the next.
void mark_corners(PathCurve& curve) {
    const double least = std::cos(20 * std::numbers::pi / 180);
    const std::size_t count = curve.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Point in = curve.points[i] - curve.points[(i + count - 1) % count],
                    out = curve.points[(i + 1) % count] - curve.points[i];
        if (in[0] * out[0] + in[1] * out[1] < least * length(in) * length(out)) curve.corners.push_back(i);
    }
}

std::vector<PathCurve> PathReader::read() {
    skip_blanks();
    for (char command = 0; place_ < text_.size(); skip_blanks()) {
        if (!is_at_number()) {
            const char letter = text_[place_];
            relative_ = letter >= 'a' && letter <= 'z';
            command = relative_ ? static_cast<char>(letter - 'a' + 'A') : letter;
            if (before_ == 0 && command != 'M') fail("a path that begins with M");
            ++place_;
            if (command == 'Z') {
                close();
                before_ = command;
                continue;
            }
        } else if (command == 'M') {
            command = 'L';  // further points of M are lines
        } else if (command == 0 || command == 'Z') {
            fail("a command");
        }
        draw(command);
    }
    close();
    for (PathCurve& curve : curves_) mark_corners(curve);
    return std::move(curves_);
}

}  // namespace

std::vector<PathCurve> read_path(std::string_view text, double tolerance) { return PathReader(text, tolerance).read(); }

}  // namespace drape::input
