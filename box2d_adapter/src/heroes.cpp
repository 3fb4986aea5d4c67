#include <paperproof/together.hpp>

#include "hero_impl.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace paperproof::box2d {

/// One hero of a party that takes turns.
class Hero::Turn final : public TurnTaker {
 public:
  /// @param party the bodies of all, in order.
  Turn(Impl& hero, const Input& input, double dt, const std::vector<b2Body*>& party)
      : hero_(hero), input_(input), dt_(dt), party_(party) {}

  [[nodiscard]] const Controller& controller() const override { return hero_.controller; }
  [[nodiscard]] CharacterState& state() override { return hero_.state; }
  [[nodiscard]] StepReport& report() override { return hero_.report; }
  [[nodiscard]] Box2 reach() const override { return hero_.controller.reach(hero_.state, hero_.context_of(dt_)); }
  [[nodiscard]] bool is_body_of(ColliderIndex collider, std::size_t other) const override {
    return hero_.fixtures.body_of(collider) == party_[other];
  }

  void step(std::span<const Other> others, bool is_taken) override {
    std::map<const b2Body*, MoverMotion> shown;
    for (const Other& other : others) shown[party_[other.who]] = other.motion;
    hero_.fixtures.show(party_, shown);
    StepContext context = hero_.context_of(dt_);
    Input input = input_;
    if (is_taken) {
      context.gravity.setZero();
      input = {};
    }
    ColliderFilter filter;
    filter.user = &hero_.fixtures;
    filter.is_there = [](ColliderIndex collider, const void* fixtures) {
      return static_cast<const NearFixtures*>(fixtures)->is_there(collider);
    };
    if (shown.size() + 1 < party_.size()) context.filter = &filter;
    const StepStatus status = hero_.attempt(context, [&](const StepContext& read) {
      return hero_.controller.step(hero_.state, input, read, hero_.scratch, hero_.report);
    });
    if (is_refused(status)) hero_.report.status = status;
  }

 private:
  Impl& hero_;
  const Input& input_;
  double dt_;
  const std::vector<b2Body*>& party_;
};

void step_together(std::span<Hero* const> heroes, std::span<const Input> inputs, double dt) {
  std::vector<Hero::Impl*> party;
  std::vector<b2Body*> bodies;
  std::vector<Hero::Turn> turns;
  turns.reserve(heroes.size());
  for (std::size_t i = 0; i < heroes.size(); ++i) {
    Hero::Impl& hero = *heroes[i]->impl_;
    if (!hero.begin(dt)) {
      hero.report.status = StepStatus::invalid_input;
      continue;
    }
    party.push_back(&hero);
    bodies.push_back(hero.body);
    turns.emplace_back(hero, inputs[i], dt, bodies);
  }
  if (party.empty()) return;
  std::vector<TurnTaker*> all;
  for (Hero::Turn& turn : turns) all.push_back(&turn);
  TogetherScratch scratch;
  take_turns(all, up_of(party.front()->gravity()), scratch);
  for (Hero::Impl* hero : party) {
    if (is_refused(hero->report.status))
      hero->state = hero->begun.state;
    else
      hero->end(dt);
    hero->fixtures.show({}, {});
  }
}

}  // namespace paperproof::box2d
