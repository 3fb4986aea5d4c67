#include "piece_finder.hpp"

#include <algorithm>
#include <tuple>

namespace paperproof {
namespace {

/// Candidates are collected at most this far ahead of a motion, in multiples of the character's larger extent. Zero:
/// every step asks the grid. Large: a fast step tests pieces that it never meets.
constexpr double look_ahead_share = 2;
/// Number of further steps like the present one for which they are collected. None: every step asks the grid. Many:
/// every step tests pieces that it never meets.
constexpr double steps_ahead = 6;
/// Their box also grows on every side, by this share of the distance ahead: for small turns.
constexpr double sides = 1.0 / 32;

}  // namespace

PieceFinder::PieceFinder(const Scenery& scenery, Kind kind, const Box2& reach, PieceSearch search)
    : scenery_(&scenery),
      kind_(kind),
      search_(search),
      reach_(reach),
      look_ahead_(look_ahead_share * reach.size().maxCoeff()) {}

void PieceFinder::find(MoverIndex mover, const Box2& box, std::vector<PieceIndex>& found) const {
  if (mover != no_mover && !box.overlaps(whole(mover))) return;
  if (search_ == PieceSearch::grid) return grid_of(mover).find(box, scenery_->boxes(), found);
  for (PieceIndex piece = 0; piece < scenery_->pieces().size(); ++piece) {
    const PieceInfo& info = scenery_->pieces()[piece];
    const bool is_one = info.mover == mover && info.sensor == (kind_ == Kind::sensors) && info.vertex_count > 0;
    if (is_one && (search_ == PieceSearch::none || scenery_->box(piece).overlaps(box))) found.push_back(piece);
  }
}

bool PieceFinder::any_comes_into(const Box2& box, const Moving& moving) const {
  for (MoverIndex mover = 0; mover < moving.motions.size(); ++mover) {
    const MoverMotion& motion = moving.motions[mover];
    const bool goes_apart = mover >= moving.mover_count();
    const Box2& its = goes_apart ? scenery_->box(moving.apart[mover - moving.mover_count()]) : whole(mover);
    const bool is_turned = !goes_apart && motion.to_angle != 0;
    if (seen_by(box, motion).overlaps(is_turned ? geometry::Turn(motion.to_angle)(its) : its)) return true;
  }
  return false;
}

Box2 box_around(std::span<const PathPoint> path, const MoverMotion& motion) {
  Box2 positions = Box2::nowhere();
  for (const PathPoint& corner : path) positions = positions.with(corner.position - motion.at(corner.fraction));
  return positions;
}

/// Appends those that are there.
/// @param box as the mover sees it, apart from its angle.
void Nearby::find(MoverIndex mover, const Box2& box, double angle, std::vector<PieceIndex>& found) const {
  const std::size_t first = found.size();
  finder_.find(mover, angle == 0 ? box : geometry::Turn(-angle)(box), found);
  const auto goes_by_itself = [&](PieceIndex piece) {
    return std::ranges::find(moving_->apart, piece) != moving_->apart.end();
  };
  if (mover != no_mover && moving_ != nullptr && !moving_->apart.empty()) [[unlikely]]
    found.erase(std::remove_if(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), goes_by_itself),
                found.end());
  arrange(first, found);
}

/// Removes the pieces that are not there, and sorts the others.
void Nearby::arrange(std::size_t first, std::vector<PieceIndex>& found) const {
  const auto before = static_cast<std::ptrdiff_t>(first);
  if (filter_ != nullptr) {
    const Scenery& scenery = finder_.scenery();
    const auto is_absent = [&](PieceIndex piece) { return !(*filter_)(scenery, scenery.pieces()[piece].collider); };
    found.erase(std::remove_if(found.begin() + before, found.end(), is_absent), found.end());
  }
  std::sort(found.begin() + before, found.end(),
            [&](PieceIndex a, PieceIndex b) { return finder_.scenery().comes_before(a, b); });
}

/// Writes the names that the user has for pieces in their places.
void Nearby::name(std::span<PieceIndex> pieces, MoverIndex motion) const {
  const bool has_motion = motion != no_mover && moving_ != nullptr && motion < moving_->mover_count();
  if (user_ != nullptr) user_->prepare(pieces, motion, has_motion ? moving_->motions[motion].to_angle : 0);
}

void Nearby::find_standing(const Box2& positions, const Vec2d& way) {
  // A step that begins elsewhere is one of another character, and the next step will be, too: pieces ahead of this
  // one are not needed.
  const bool goes_on = !known_.valid || known_.box.overlaps(positions);
  const Vec2d most = Vec2d::Constant(goes_on ? finder_.look_ahead() : 0);
  const Vec2d ahead = (way * steps_ahead).cwiseMin(most).cwiseMax(-most);
  known_.box = positions.merged(positions + ahead).inflated(finder_.look_ahead() * sides);
  known_.pieces.clear();
  find(no_mover, finder_.touched_from(known_.box), 0, known_.pieces);
  name(known_.pieces, no_mover);
  known_.valid = true;
}

void Nearby::find_moving(const Box2& positions) {
  const Box2 wanted = positions.inflated(finder_.look_ahead() * sides);
  known_.moving_box = known_.moving_valid ? known_.moving_box.merged(wanted) : wanted;
  const Box2 touched = finder_.touched_from(known_.moving_box);
  known_.moving.clear();
  known_.of_movers.clear();
  for (MoverIndex mover = 0; mover < moving_->motions.size(); ++mover) add_moving(mover, touched);
  // By motion and content, so that movers that are alike give the same bits, whatever their numbers are.
  const auto key = [&](const Candidates::OfMover& each) {
    const MoverMotion& motion = moving_->motions[each.mover];
    return std::tuple(motion.from.x(), motion.from.y(), motion.to.x(), motion.to.y(), motion.to_angle);
  };
  std::ranges::sort(known_.moving, [&](const auto& a, const auto& b) {
    if (key(a) != key(b)) return key(a) < key(b);
    return finder_.scenery().comes_before(known_.of_movers[a.first], known_.of_movers[b.first]);
  });
  for (const auto& [mover, first, end] : known_.moving)
    name(std::span(known_.of_movers).subspan(first, end - first), mover);
  known_.moving_valid = true;
}

/// Appends what has a motion.
void Nearby::add_moving(MoverIndex mover, const Box2& touched) {
  const MoverMotion& motion = moving_->motions[mover];
  const Box2 box = PieceFinder::seen_by(touched, motion);
  std::vector<PieceIndex>& found = known_.of_movers;
  const std::size_t first = found.size();
  if (mover >= moving_->mover_count()) {
    const PieceIndex piece = moving_->apart[mover - moving_->mover_count()];
    if (!finder_.has(piece) || !box.overlaps(finder_.scenery().box(piece))) return;
    found.push_back(piece);
    arrange(first, found);
  } else {
    find(mover, box, motion.to_angle, found);
  }
  if (found.size() > first) known_.moving.push_back({mover, first, found.size()});
}

std::span<PieceIndex> Nearby::take(const Box2& positions) {
  forget();
  find_standing(positions, Vec2d::Zero());
  for_each_moving(positions, [&](std::span<const PieceIndex> pieces, MoverIndex) {
    known_.pieces.insert(known_.pieces.end(), pieces.begin(), pieces.end());
  });
  forget();
  return known_.pieces;
}

void Nearby::reserve(const Box2& positions) {
  known_.moving.reserve(finder_.scenery().mover_count());
  known_.of_movers.clear();
  for (MoverIndex mover = 0; mover < finder_.scenery().mover_count(); ++mover)
    find(mover, finder_.whole(mover), 0, known_.of_movers);
  name(known_.of_movers, 0);
  known_.pieces.clear();
  find(no_mover, finder_.touched_from(positions.inflated(2 * finder_.look_ahead())), 0, known_.pieces);
  name(known_.pieces, no_mover);
  known_.pieces.reserve(known_.pieces.size() + known_.of_movers.size());
  forget();
}

void Nearby::follow_edits() {
  forget();
  if (user_ != nullptr) user_->follow_edits();
  known_.edit = finder_.scenery().edits().count();
}

/// Forgets the pieces that were collected with another filter.
void Nearby::forget_others() {
  const ColliderFilter filter = filter_ != nullptr ? *filter_ : ColliderFilter{};
  const bool by_predicate = filter.is_there != nullptr || known_.filter.is_there != nullptr;  // may say otherwise now
  const bool same = Filter(filter) == Filter(known_.filter);
  if ((filter_ != nullptr) != known_.filtered || by_predicate || !same) forget();
  known_.filtered = filter_ != nullptr;
  known_.filter = filter;
}

}  // namespace paperproof
