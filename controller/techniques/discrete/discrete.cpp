/// The article's discrete collision detection: see `discrete::Solver`. The character is a body, and so are others that
/// move with it in a `TechniqueCrowd`, all in one solve (this is a `JointTechnique`). Movers are bodies that nothing
/// can move.
///
/// The knob `iterations` is the number of rounds, each with its own search for nearby pieces; the others have no
/// meaning here. Here the article's "more iterations" shows: where two surfaces push into each other every round leaves
/// a share of the depth that it found (`wedge_60`, `valley`, `leaning_valley`).
///
/// The response is the solver's: the part of the motion into a normal is taken away. The corners of the
/// character are one convex body, whichever `points` are chosen, so nothing slips between two of them; but only the
/// start and the end of a step are looked at, so paper is passed. A one-way segment stops what begins on its side of
/// the normal. Stopped motion leaves a gap of `Tolerances::stop`. A contact's fraction is its time of impact.
///
/// What stands on a mover is carried: the frame is worked out in the mover's frame of reference. What comes to rest on
/// it is carried at once, unless it had a speed of its own along it. A mover's push that leads through something that
/// stands still, or ends in it, is none: the character stays where it was, and is crushed.
///
/// **Several characters**: nothing is guaranteed. One joint solve moves all of them, as bodies of the same mass. It
/// tests only the beginning and the expected end of the step. Each character has a box around these two positions;
/// characters with overlapping boxes form an island. In each island, characters that are expected to overlap at the end
/// are pushed apart in order of time of impact, each by half of the overlap, and both go on with the mean of their
/// velocities along the normal. This is repeated `iterations` times, with all pieces nearby. So characters push each
/// other, also into and through solids; a fast one passes another; and stacks sink into themselves. A character that is
/// alone moves as by `TechniqueController`, bit for bit. A character that lands on another stands on it, and is not
/// carried along. A character that a mover would push through a standing solid stays where it was, crushed, and blocks
/// the others. If on average more than 256 bodies are near each character, the bodies beyond this number are ignored,
/// and every character is `dropped`. Cost: sorting boxes, a little more than n.
#include "geometry/overlap_time.hpp"
#include "techniques/article_response.hpp"
#include "techniques/discrete/frame.hpp"
#include "techniques/knobs.hpp"
#include "techniques/registry.hpp"

#include <paperproof/tolerances.hpp>

namespace paperproof {
namespace {

using discrete::Body;
using discrete::BodyIndex;
using discrete::Frame;
using discrete::SolvedImpact;
using discrete::Workplace;

class Discrete final : public JointTechnique {
 public:
  Discrete(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character)
      : scenery_(&scenery),
        broad_phase_(make_broad_phase(def.broad_phase, standing_boxes(scenery))),
        box_(character.shape.box()),
        iterations_(def.article.iterations),
        fastest_surface_(fastest_surface(scenery)) {
    for (const Vec2d& corner : character.shape.hull()) outline_.push_back(corner);
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "discrete"; }
  [[nodiscard]] Scratch make_scratch() const override { return make_joint_scratch(1); }
  [[nodiscard]] Scratch make_joint_scratch(std::size_t most_characters) const override;
  void move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept override;
  bool move_together(std::span<const MoveRequest> requests, Scratch& scratch,
                     CrowdReport& report) const noexcept override;

 private:
  using Frames = std::span<Frame>;

  /// What the character overlaps.
  struct Inside {
    bool anything = false;
    bool what_stands_still = false;           ///< By however little: a push must not lead into it.
    FixedVector<ColliderIndex, 64> movers{};  ///< Colliders of those that move in this step.
  };

  void add_frame(const MoveRequest& request, MoveResult& result, CrowdMember* member,
                 std::vector<Frame>& frames) const noexcept;
  [[nodiscard]] std::size_t move_all(Scratch& scratch) const noexcept;
  [[nodiscard]] Body body_of(PieceIndex piece, const FrameOfReference& place) const noexcept;
  [[nodiscard]] std::span<Body> gather(std::span<const Frame> frames, Scratch& scratch) const noexcept;
  void note_company(Frames frames, const Workplace& work) const noexcept;
  [[nodiscard]] std::size_t report(Frames frames, const Workplace& work) const noexcept;
  void report_piece(Frame& frame, const discrete::Impact& impact, PieceIndex piece) const noexcept;
  void report_meeting(Frames frames, const SolvedImpact& solved) const noexcept;
  [[nodiscard]] bool take_along(Frame& frame, ColliderIndex ground, double time) const noexcept;
  [[nodiscard]] bool pushed_through(Frames frames, BodyIndex character, Scratch& scratch) const noexcept;
  [[nodiscard]] bool passes_static(const Vec2d& from, const Vec2d& to, Scratch& scratch) const noexcept;
  [[nodiscard]] Inside find_inside(const Frame& frame, bool at_end, Scratch& scratch) const noexcept;
  void stay(Frame& frame) const noexcept;
  void finish(Frame& frame, Scratch& scratch) const noexcept;
  void arrive(Frame& frame) const noexcept;
  void measure_gaps(const Vec2d& position, MoveResult& result) const noexcept;

  const Scenery* scenery_;
  std::unique_ptr<BroadPhase> broad_phase_;
  FixedVector<Vec2d, CharacterShape::max_points> outline_;
  Box2 box_;
  int iterations_;
  double fastest_surface_;
};

Workplace& workplace_of(Scratch& scratch) noexcept { return static_cast<Workplace&>(*scratch.own); }

Scratch Discrete::make_joint_scratch(std::size_t most_characters) const {
  const std::size_t pieces = scenery_->pieces().size();
  Scratch scratch;
  scratch.solids.pieces.reserve(pieces);
  auto own = std::make_unique<Workplace>();
  own->frames.reserve(most_characters);
  own->bodies.reserve(pieces + most_characters);
  own->near.reserve(pieces);
  own->gathered.resize(pieces);
  // Each character with each piece and each other one; pieces do not meet each other.
  const std::size_t all_pairs = most_characters * pieces + most_characters * (most_characters - 1) / 2;
  own->solver.reserve(pieces + most_characters,
                      std::min(all_pairs, pieces + discrete::most_pairs_each * most_characters));
  scratch.own = std::move(own);
  return scratch;
}

void Discrete::move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept {
  if (article::leaves_range(*scenery_, fastest_surface_, request)) return article::refuse(request, result);
  std::vector<Frame>& frames = workplace_of(scratch).frames;
  frames.clear();
  add_frame(request, result, nullptr, frames);
  (void)move_all(scratch);
}

bool Discrete::move_together(std::span<const MoveRequest> requests, Scratch& scratch,
                             CrowdReport& report) const noexcept {
  const auto leaves = [&](const MoveRequest& request) {
    return article::leaves_range(*scenery_, fastest_surface_, request);
  };
  if (std::any_of(requests.begin(), requests.end(), leaves)) return false;
  std::vector<Frame>& frames = workplace_of(scratch).frames;
  frames.clear();
  for (std::size_t i = 0; i < requests.size(); ++i)
    add_frame(requests[i], report.members[i].step.move, &report.members[i], frames);
  report.impacts = move_all(scratch);
  return true;
}

/// The character as it wants to move.
void Discrete::add_frame(const MoveRequest& request, MoveResult& result, CrowdMember* member,
                         std::vector<Frame>& frames) const noexcept {
  result.clear();
  Frame& frame = frames.emplace_back(Frame{request, FrameOfReference(*scenery_, request), result, member});
  frame.character.outline = std::span<const Vec2d>(outline_.begin(), outline_.end());
  frame.character.box = box_;
  frame.character.base = frame.place.motion_of(frame.place.mover());
  frame.character.position = frame.place.start();
  frame.character.movement = frame.place.wanted();
  frame.character.velocity = frame.place.velocity();
  frame.character.drops = request.drop;
}

/// All frames of the workplace. @return how many impacts between characters were solved.
std::size_t Discrete::move_all(Scratch& scratch) const noexcept {
  Workplace& work = workplace_of(scratch);
  const Frames frames = work.frames;
  std::size_t impacts = 0;
  bool left_over = true;
  bool overflowed = false;
  for (int iteration = 0; left_over && iteration < iterations_; ++iteration) {
    for (Frame& frame : frames) frame.expected = frame.character.expected();
    const std::span<Body> bodies = gather(frames, scratch);
    work.solver.solve_once(bodies);
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i].character = bodies[i];
    if (iteration == 0) note_company(frames, work);
    overflowed = overflowed || work.solver.overflowed();
    impacts += report(frames, work);
    for (BodyIndex i = 0; i < frames.size(); ++i)
      if (pushed_through(frames, i, scratch)) stay(frames[i]);
    left_over = std::any_of(frames.begin(), frames.end(), [](const Frame& frame) { return frame.left_over; });
  }
  for (Frame& frame : frames) {
    if (overflowed && !frame.stays) frame.result.status = StepStatus::dropped;
    finish(frame, scratch);
  }
  return impacts;
}

/// A piece as it goes, in the frame of reference of its mover.
Body Discrete::body_of(PieceIndex piece, const FrameOfReference& place) const noexcept {
  const PieceInfo& info = scenery_->pieces()[piece];
  Body body;
  body.outline = scenery_->vertices_of(piece);
  body.box = scenery_->box(piece);
  body.base = place.motion_of(info.mover);
  body.velocity = place.velocity(info.mover);
  body.inverse_mass = 0;
  body.one_way = info.one_way;
  return body;
}

/// The characters and all pieces near the total box of any of them.
std::span<Body> Discrete::gather(std::span<const Frame> frames, Scratch& scratch) const noexcept {
  Workplace& work = workplace_of(scratch);
  work.near.clear();  // keeps its memory, as all of them
  const auto add = [&work](PieceIndex piece) {
    if (work.gathered[piece] != 0) return;
    work.gathered[piece] = 1;
    work.near.push_back(piece);
  };
  const PieceRange moving = moving_pieces(*scenery_);
  for (const Frame& frame : frames) {
    const Box2 total = frame.character.total_box();
    scratch.solids.pieces.clear();
    broad_phase_->query(total, scratch.solids.pieces);
    for (const PieceIndex piece : scratch.solids.pieces) add(piece);
    for (PieceIndex piece = moving.first; piece < moving.end; ++piece)
      if (body_of(piece, frame.place).total_box().overlaps(total)) add(piece);
  }
  for (const PieceIndex piece : work.near) work.gathered[piece] = 0;
  if (frames.size() > 1) std::sort(work.near.begin(), work.near.end());
  work.bodies.clear();
  for (const Frame& frame : frames) work.bodies.push_back(frame.character);
  for (const PieceIndex piece : work.near) work.bodies.push_back(body_of(piece, frames.front().place));
  return work.bodies;
}

/// Who is at risk of colliding with whom when the step begins, and who overlaps.
void Discrete::note_company(Frames frames, const Workplace& work) const noexcept {
  for (BodyIndex i = 0; i < frames.size(); ++i)
    if (frames[i].member != nullptr) frames[i].member->island = work.solver.island_of(i);
  for (const discrete::Pair& pair : work.solver.pairs()) {
    if (pair.second >= frames.size()) continue;
    const Body& first = frames[pair.first].character;
    const Body& second = frames[pair.second].character;
    if (!discrete::began_overlapping(first, second, Tolerances{}.certain)) continue;
    frames[pair.first].member->started_overlapping.push_back(pair.second);
    frames[pair.second].member->started_overlapping.push_back(pair.first);
  }
  for (Frame& frame : frames)
    if (frame.member != nullptr)
      std::sort(frame.member->started_overlapping.begin(), frame.member->started_overlapping.end());
}

/// What the last round pushed apart. @return how many of these were two characters.
std::size_t Discrete::report(Frames frames, const Workplace& work) const noexcept {
  std::size_t meetings = 0;
  for (Frame& frame : frames) frame.left_over = false;
  for (const SolvedImpact& each : work.solver.solved()) {
    frames[each.bodies.first].left_over = true;
    if (each.bodies.second < frames.size()) {
      report_meeting(frames, each);
      ++meetings;
    } else {
      report_piece(frames[each.bodies.first], each.impact, work.near[each.bodies.second - frames.size()]);
    }
  }
  return meetings;
}

void Discrete::report_piece(Frame& frame, const discrete::Impact& impact, PieceIndex piece) const noexcept {
  const PieceInfo& info = scenery_->pieces()[piece];
  const Side side = side_of_normal(impact.normal.x(), impact.normal.y());
  article::add_contact(*scenery_, {piece, impact.point, impact.normal, impact.time}, side, impact.time, frame.result);
  if (info.mover != no_mover && !frame.place.motion(info.mover).isZero(0))
    article::add_once(info.collider, frame.pushers);
  if (side != Side::bottom) return;
  frame.result.grounded = true;
  frame.result.ride.ground = frame.place.carries(info.collider) ? info.collider : Ride::none;
  frame.left_over = take_along(frame, info.collider, impact.time) || frame.left_over;
}

/// Who comes down on another stands on it, and is not carried along.
void Discrete::report_meeting(Frames frames, const SolvedImpact& solved) const noexcept {
  const auto note = [&](BodyIndex one, BodyIndex other, const Vec2d& normal) {
    Frame& frame = frames[one];
    frame.member->add_contact(other, normal, solved.impact.time, UpFrame{});
    if (frame.stays) return;
    frame.left_over = true;
    if (side_of_normal(normal.x(), normal.y()) == Side::bottom) frame.result.grounded = true;
  };
  note(solved.bodies.first, solved.bodies.second, solved.impact.normal);
  note(solved.bodies.second, solved.bodies.first, -solved.impact.normal);
}

/// What comes to rest on moving ground is carried for the rest of the frame, unless it had a speed of its own along it.
bool Discrete::take_along(Frame& frame, ColliderIndex ground, double time) const noexcept {
  if (!frame.place.carries(ground) || frame.request.ride.ground != Ride::none) return false;
  if (frame.request.velocity.x() != 0 || frame.character.velocity.x() != 0) return false;
  const Vec2d motion = frame.place.motion(frame.place.mover_of(ground)) + frame.place.surface_motion(ground);
  frame.character.movement.x() += motion.x() * (1 - time);
  frame.character.velocity.x() = frame.place.velocity_of(ground).x();
  return motion.x() != 0;
}

/// One of the last round's pushes by a mover led through something that stands still.
bool Discrete::pushed_through(Frames frames, BodyIndex character, Scratch& scratch) const noexcept {
  const Frame& frame = frames[character];
  if (frame.pushers.empty() || frame.stays) return false;
  const Workplace& work = workplace_of(scratch);
  const Vec2d shift = frame.place.shift_at_end(no_mover);
  Vec2d expected = frame.expected;
  for (const SolvedImpact& each : work.solver.solved()) {
    const Vec2d from = expected;
    if (each.bodies.second == character) expected += each.second_push;
    if (each.bodies.first != character) continue;
    expected += each.first_push;
    const bool by_another = each.bodies.second < frames.size();
    if (by_another || scenery_->pieces()[work.near[each.bodies.second - frames.size()]].mover == no_mover) continue;
    if (passes_static(from + shift, expected + shift, scratch)) return true;
  }
  return false;
}

/// A push leads through a piece that stands still, from one side of it to another.
bool Discrete::passes_static(const Vec2d& from, const Vec2d& to, Scratch& scratch) const noexcept {
  using Time = geometry::OverlapTime;
  std::vector<PieceIndex>& in_way = scratch.solids.pieces;
  in_way.clear();
  broad_phase_->query(Box2::between(from, to) + box_, in_way);
  return std::ranges::any_of(in_way, [&](PieceIndex piece) {
    if (scenery_->pieces()[piece].one_way) return false;
    const Time time =
        geometry::overlap_time(geometry::separating_axes(outline_, scenery_->vertices_of(piece)), from, to);
    return time.any() && time.begin != Time::before && time.end != Time::after;
  });
}

/// Where the step begins, or where the character is expected to end.
typename Discrete::Inside Discrete::find_inside(const Frame& frame, bool at_end, Scratch& scratch) const noexcept {
  const auto placed = [&](Body body) {
    if (at_end) body.position = body.expected();
    body.base = at_end ? MoverMotion{body.base.to, body.base.to} : MoverMotion{body.base.from, body.base.from};
    body.movement.setZero();
    return body;
  };
  Inside inside;
  const std::span<const Body> bodies = gather({&frame, 1}, scratch);
  const Body character = placed(bodies.front());
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const Body body = placed(bodies[i]);
    const PieceInfo& info = scenery_->pieces()[workplace_of(scratch).near[i - 1]];
    if (info.mover == no_mover && discrete::began_overlapping(character, body, 0)) inside.what_stands_still = true;
    if (!discrete::began_overlapping(character, body, Tolerances{}.touch)) continue;
    inside.anything = true;
    if (info.mover != no_mover && !frame.place.motion(info.mover).isZero(0))
      article::add_once(info.collider, inside.movers);
  }
  return inside;
}

/// Nothing is pushed into what stands still, or through it. For others it is in the way there, and nothing moves it.
void Discrete::stay(Frame& frame) const noexcept {
  frame.result.crushed.assign(frame.pushers.begin(), frame.pushers.end());
  article::stay_crushed(frame.request, frame.result);
  frame.stays = true;
  frame.left_over = false;
  frame.character.base = {};
  frame.character.position = frame.request.position;
  frame.character.movement.setZero();
  frame.character.velocity.setZero();
  frame.character.inverse_mass = 0;
}

/// After the last round.
void Discrete::finish(Frame& frame, Scratch& scratch) const noexcept {
  if (frame.stays) return;
  if (frame.left_over || scenery_->mover_count() > 0) {
    const Inside begin = find_inside(frame, false, scratch);
    const Inside end = find_inside(frame, true, scratch);
    if (end.what_stands_still && !begin.what_stands_still && !frame.pushers.empty()) return stay(frame);
    frame.result.crushed.assign(end.movers.begin(), end.movers.end());
    if (frame.left_over && begin.anything && end.anything) frame.result.status = StepStatus::stuck;
    if (!frame.result.crushed.empty()) frame.result.status = StepStatus::crushed;
  }
  arrive(frame);
}

/// In the world, and on what carries the character.
void Discrete::arrive(Frame& frame) const noexcept {
  MoveResult& result = frame.result;
  const Vec2d position = frame.character.expected();
  measure_gaps(position, result);
  for (Contact& contact : result.contacts) contact.point = frame.place.in_world(contact.point, 1);
  result.velocity = frame.character.velocity;
  frame.place.arrive(position, result);
  result.path.push_back({frame.request.position, 0});
  result.path.push_back({result.position, 1});
}

/// Along each contact's normal, from the obstacle to the nearest corner of the character where it ended.
void Discrete::measure_gaps(const Vec2d& position, MoveResult& result) const noexcept {
  for (Contact& contact : result.contacts) {
    const auto height_of = [&](const Vec2d& corner) {
      const Vec2d from_point = position + corner - contact.point;
      return from_point.dot(contact.normal);
    };
    contact.separation = height_of(outline_[0]);
    for (const Vec2d& corner : outline_) contact.separation = std::min(contact.separation, height_of(corner));
  }
}

}  // namespace

TechniqueEntry discrete_entry() {
  TechniqueEntry entry = entry_of<Discrete>("discrete", {knob::iterations, knob::broad_phase});
  entry.knows_movers = entry.moves_crowds = true;
  return entry;
}

}  // namespace paperproof
