#include <paperproof/saved_state.hpp>

#include <algorithm>

namespace paperproof {
namespace {

/// Visits every member of a state, always in the same order. Written once, for saving and for restoring.
template <class State, class Visit>
void for_each_member(State& state, std::uint32_t& crusher_count, const Visit& visit) {
  const auto vector = [&](auto& v) {
    visit(v.x());
    visit(v.y());
  };
  for (auto* v : {&state.position, &state.velocity, &state.last_free, &state.technique_memory, &state.ride.place,
                  &state.ride.velocity, &state.ground.normal, &state.ground.velocity})
    vector(*v);
  visit(state.coyote_left);
  visit(state.pending_left);
  visit(state.ride.ground);
  visit(state.ground.collider);
  visit(state.ground.state);
  visit(state.stuck_steps);
  for (auto* flag : {&state.has_last_free, &state.grounded, &state.jumping, &state.jump_held, &state.jump_pending,
                     &state.wall_left, &state.wall_right, &state.crushed})
    visit(*flag);
  visit(crusher_count);
  for (auto& crusher : state.crushers) {
    visit(crusher.collider);
    vector(crusher.last_free);
    vector(crusher.displacement);
    visit(crusher.has_side);
  }
}

}  // namespace

SavedState save(const CharacterState& state) noexcept {
  SavedState saved{};
  double* number = saved.numbers;
  std::uint32_t* index = saved.indices;
  std::uint8_t* mark = saved.marks;
  auto count = static_cast<std::uint32_t>(state.crushers.size());
  for_each_member(state, count, [&]<class T>(const T& value) {
    if constexpr (std::is_same_v<T, double>)
      *number++ = value + 0.0;  // a negative zero becomes a positive one
    else if constexpr (std::is_same_v<T, std::uint32_t>)
      *index++ = value;
    else
      *mark++ = static_cast<std::uint8_t>(value);
  });
  return saved;
}

CharacterState restored(const SavedState& saved) noexcept {
  CharacterState state;
  const double* number = saved.numbers;
  const std::uint32_t* index = saved.indices;
  const std::uint8_t* mark = saved.marks;
  constexpr std::size_t where_the_count_is = 2;
  const std::size_t count = std::min<std::size_t>(saved.indices[where_the_count_is], state.crushers.capacity());
  for (std::size_t i = 0; i < count; ++i) state.crushers.push_back({});
  std::uint32_t ignored = 0;
  for_each_member(state, ignored, [&]<class T>(T& value) {
    if constexpr (std::is_same_v<T, double>)
      value = *number++;
    else if constexpr (std::is_same_v<T, std::uint32_t>)
      value = *index++;
    else if constexpr (std::is_same_v<T, GroundState>)
      value = static_cast<GroundState>(std::min<std::uint8_t>(*mark++, 3));
    else
      value = static_cast<T>(*mark++);
  });
  return state;
}

}  // namespace paperproof
