/// Tiled maps: objects, starts, files, and maps that nobody in this project drew.
#include "compare/tiled_maps.hpp"

#include <paperproof/controller.hpp>

namespace paperproof::compare {
namespace {

TEST(TiledObjects, shapes_become_polygons_and_chains) {
  const SceneFiles files;
  const Scene scene = files.load("map.tmx", tmx(objects("Collisions", R"(
      <object id="5" x="0" y="32" width="64" height="16"/>
      <object id="6" class="slope" x="32" y="32"><polygon points="0,0 16,-16 16,0"/></object>
      <object id="7" x="0" y="0"><polyline points="0,0 0,32"/></object>
      <object id="8" type="platform" x="16" y="16"><polyline points="0,0 16,0"/></object>)") +
                                                objects("a", R"(<object id="1" name="hero" x="2" y="8"/>)")));
  EXPECT_EQ(corners(collider(scene, "o5")), box_corners(0, -3, 4, -2));
  EXPECT_EQ(collider(scene, "o6").points, (std::vector<Vec2d>{{2, -2}, {3, -1}, {3, -2}}));
  EXPECT_EQ(collider(scene, "o7").shape, ColliderDef::Shape::chain);
  EXPECT_FALSE(collider(scene, "o7").one_way.has_value());
  EXPECT_EQ(collider(scene, "o8").one_way, Vec2d(0, 1));
  // The sprite's upper left corner is the object's: 10 px right and 20 px down of it is the centre, at 32 px/m.
  EXPECT_EQ(scene.start.position, Vec2d(2 / 16.0 + 10 / 32.0, -8 / 16.0 - 20 / 32.0));
}

TEST(TiledObjects, a_tile_object_stands_on_its_y_and_stretches_to_its_size) {
  const SceneFiles files;
  const std::string object = R"(<object id="5" gid="1" x="16" y="48" width="32" height="24">
      <properties><property name="bodyType" value="static"/></properties></object>
      <object id="6" gid="1" x="0" y="48" width="8" height="8">
      <properties><property name="bodyType" value="dynamic"/></properties></object>)";
  const Scene scene = files.load("map.tmx", tmx(objects("things", object)));
  ASSERT_EQ(scene.ids.size(), 1U);
  EXPECT_EQ(corners(collider(scene, "o5")), box_corners(1, -3, 3, -1.5));
}

TEST(TiledObjects, rotation_is_clockwise_about_the_objects_own_point_and_exact_for_quarter_turns) {
  const SceneFiles files;
  const auto rotated = [&](const std::string& degrees, const std::string& attributes) {
    return files.load("map.tmx",
                      tmx(objects("collision", "<object id=\"5\" rotation=\"" + degrees + "\" " + attributes + "/>" +
                                                   R"(<object id="6" x="0" y="44" width="64" height="4"/>)")));
  };
  const std::string box = R"(x="32" y="16" width="16" height="8")";
  EXPECT_EQ(corners(collider(rotated("90", box), "o5")), box_corners(1.5, -2, 2, -1));
  EXPECT_EQ(corners(collider(rotated("180", box), "o5")), box_corners(1, -1, 2, -0.5));
  EXPECT_EQ(corners(collider(rotated("-90", box), "o5")), box_corners(2, -1, 2.5, 0));
  EXPECT_EQ(corners(collider(rotated("450", box), "o5")), box_corners(1.5, -2, 2, -1));
  // A tile object's point is its lower left corner.
  EXPECT_EQ(corners(collider(rotated("90", R"(gid="1" x="16" y="16" width="16" height="16")"), "o5")),
            box_corners(1, -2, 2, -1));
  for (const double degrees : {1.0, 30.0, 44.9, 45.0, 45.1, 123.4, -77.7, 1000.3}) {
    const ColliderDef turned =
        collider(rotated(std::to_string(degrees), R"(x="0" y="0" width="16" height="16")"), "o5");
    const double angle = std::stod(std::to_string(degrees)) * std::acos(-1.0) / 180;
    EXPECT_NEAR(turned.points[1].x(), std::cos(angle), 1e-13) << degrees;
    EXPECT_NEAR(turned.points[1].y(), -std::sin(angle), 1e-13) << degrees;
  }
}

std::string round_object(const std::string& kind, const std::string& attributes) {
  return "<object id=\"9\" " + attributes + "><" + kind + "/></object>";
}

Scene with_solid(const SceneFiles& files, const std::string& object) {
  return files.load("map.tmx", tmx(objects("solid", object) + csv_layer(floor_csv) + spawn));
}

TEST(TiledObjects, a_round_object_as_wide_as_high_is_a_circle) {
  const SceneFiles files;
  for (const char* kind : {"ellipse", "capsule"}) {
    const Scene scene = with_solid(files, round_object(kind, R"(x="32" y="8" width="8" height="8")"));
    const ColliderDef& round = collider(scene, "o9");
    EXPECT_EQ(round.shape, ColliderDef::Shape::circle);
    EXPECT_EQ(round.points, std::vector<Vec2d>{Vec2d(36 / 16.0, -12 / 16.0)});
    EXPECT_EQ(round.radius, 4 / 16.0);
    EXPECT_EQ(scene.notes, std::vector<std::string>{"1 object as wide as high and round is a circle"});
  }
  // A quarter turn clockwise about its corner takes the centre to the left.
  const Scene turned = with_solid(files, round_object("ellipse", R"(x="40" y="8" width="8" height="8" rotation="90")"));
  EXPECT_EQ(collider(turned, "o9").points, std::vector<Vec2d>{Vec2d(36 / 16.0, -12 / 16.0)});
}

/// How far a point is from an ellipse's curve, as a factor: 1 is on it.
double on_ellipse(const Vec2d& p, const Vec2d& centre, const Vec2d& radii) {
  return (p - centre).cwiseQuotient(radii).norm();
}

TEST(TiledObjects, another_ellipse_is_a_polygon_on_its_curve_and_close_to_it) {
  const SceneFiles files;
  const Scene scene = with_solid(files, round_object("ellipse", R"(x="28" y="2" width="36" height="10")"));
  const ColliderDef& round = collider(scene, "o9");
  ASSERT_EQ(round.shape, ColliderDef::Shape::polygon);
  EXPECT_EQ(scene.notes,
            std::vector<std::string>{"1 ellipse has straight edges, at most 0.125 px inside of the curve"});
  const Vec2d centre{46 / 16.0, -7 / 16.0};
  const Vec2d radii{18 / 16.0, 5 / 16.0};
  // Edges of angle d on a circle of 18 px lie 18 (1 - cos d/2) px inside at most; the ellipse is flatter.
  EXPECT_EQ(round.points.size(), 28U) << "18 (1 - cos(90 / 7 / 2 degrees)) = 0.113, and with 6 edges 0.154";
  const Box2<double> box = Box2<double>::around(round.points);
  EXPECT_EQ(box.lower, Vec2d(28 / 16.0, -12 / 16.0));
  EXPECT_EQ(box.upper, Vec2d(64 / 16.0, -2 / 16.0));
  for (std::size_t i = 0; i < round.points.size(); ++i) {
    const Vec2d& a = round.points[i];
    const Vec2d& b = round.points[(i + 1) % round.points.size()];
    EXPECT_NEAR(on_ellipse(a, centre, radii), 1, 1e-14);
    // In units of the radii the middle of an edge is 1 - cos d/2 inside.
    EXPECT_GE(on_ellipse((a + b) / 2, centre, radii), 1 - 0.125 / 18);
  }
}

TEST(TiledObjects, a_capsule_has_half_circles_at_its_ends) {
  const SceneFiles files;
  const Scene scene = with_solid(files, round_object("capsule", R"(x="28" y="2" width="32" height="8")"));
  const ColliderDef& capsule = collider(scene, "o9");
  ASSERT_EQ(capsule.shape, ColliderDef::Shape::polygon);
  EXPECT_EQ(scene.notes,
            std::vector<std::string>{"1 capsule has straight edges, at most 0.125 px inside of the curve"});
  for (const Vec2d& point : capsule.points) {
    // 4 px from the middle line, which goes from 32 to 56 px.
    const Vec2d nearest{std::clamp(point.x(), 32 / 16.0, 56 / 16.0), -6 / 16.0};
    EXPECT_NEAR((point - nearest).norm(), 4 / 16.0, 1e-15);
  }
  const auto has = [&](double x, double y) {
    return std::find(capsule.points.begin(), capsule.points.end(), Vec2d(x / 16, -y / 16)) != capsule.points.end();
  };
  EXPECT_TRUE(has(32, 2) && has(56, 2) && has(32, 10) && has(56, 10) && has(28, 6) && has(60, 6));
  // Upright, its half circles are above and below.
  const Scene upright = with_solid(files, round_object("capsule", R"(x="28" y="0" width="8" height="28")"));
  EXPECT_EQ(Box2<double>::around(collider(upright, "o9").points).upper, Vec2d(36 / 16.0, 0));
}

TEST(TiledObjects, round_ones_are_counted_ignored_without_a_mark_and_blocking_from_above_as_platforms) {
  const SceneFiles files;
  const std::string three = R"(<object id="9" x="0" y="2" width="8" height="6"><ellipse/></object>
      <object id="10" x="20" y="2" width="8" height="6"><ellipse/></object>
      <object id="11" x="40" y="2" width="8" height="8"><ellipse/></object>)";
  EXPECT_EQ(files.load("map.tmx", tmx(objects("coins", three) + csv_layer(floor_csv) + spawn)).ids.size(), 4U);
  const std::string elsewhere = R"(<objectgroup name="spawn"><object id="1" x="50" y="11"/></objectgroup>)";
  const auto notes = [&](const std::string& layer) {
    return files.load("map.tmx", tmx(objects(layer, three) + csv_layer(floor_csv) + elsewhere));
  };
  EXPECT_EQ(notes("solid").notes,
            (std::vector<std::string>{"1 object as wide as high and round is a circle",
                                      "2 ellipses have straight edges, at most 0.125 px inside of the curve"}));
  const Scene platforms = notes("one_way");
  const ColliderDef& round = collider(platforms, "o11");
  EXPECT_EQ(round.shape, ColliderDef::Shape::chain);
  EXPECT_EQ(round.one_way, Vec2d(0, 1));
  EXPECT_EQ(round.points.front(), Vec2d(40 / 16.0, -6 / 16.0)) << "its left end, half way down";
  EXPECT_EQ(round.points.back(), Vec2d(48 / 16.0, -6 / 16.0));
}

TEST(TiledObjects, a_tile_that_is_stretched_makes_an_ellipse_of_its_circle) {
  const SceneFiles files;
  const std::string tile =
      R"(<tile id="0" class="solid"><objectgroup><object id="1" x="4" y="4" width="8" height="8"><ellipse/></object></objectgroup></tile>)";
  const auto shown = [&](const std::string& size) {
    return files.load("map.tmx", tmx(objects("things", "<object id=\"5\" gid=\"1\" x=\"0\" y=\"32\" " + size + "/>") +
                                         csv_layer("0,0,0,0, 0,0,0,0, 2,2,2,2") + spawn,
                                     tile));
  };
  // Half as large: its centre is 4 px right of and 4 px above the lower left corner.
  const Scene half = shown("width=\"8\" height=\"8\"");
  EXPECT_EQ(collider(half, "o5").points, std::vector<Vec2d>{Vec2d(4 / 16.0, -28 / 16.0)});
  EXPECT_EQ(collider(half, "o5").radius, 2 / 16.0);
  const Scene flat = shown("width=\"16\" height=\"8\"");
  EXPECT_EQ(collider(flat, "o5").shape, ColliderDef::Shape::polygon);
  const Box2<double> box = Box2<double>::around(collider(flat, "o5").points);
  EXPECT_EQ(box.lower, Vec2d(4 / 16.0, -30 / 16.0));
  EXPECT_EQ(box.upper, Vec2d(12 / 16.0, -26 / 16.0));
}

TEST(TiledObjects, points_and_empty_rectangles_are_left_out_with_a_note) {
  const SceneFiles files;
  const std::string nothing = R"(<object id="9" x="1" y="1"><point/></object><object id="10" x="1" y="1"/>)";
  const Scene scene = files.load("map.tmx", tmx(objects("collision", nothing) + csv_layer(floor_csv) + spawn));
  EXPECT_EQ(scene.ids.size(), 4U);
  EXPECT_EQ(scene.notes.size(), 2U);
}

TEST(TiledObjects, a_moving_platform_goes_from_turning_point_to_turning_point_and_back) {
  const SceneFiles files;
  const std::string mover = R"(<object id="9" gid="1" x="48" y="32" width="16" height="16"><properties>
      <property name="change_y" type="float" value="2"/><property name="boundary_top" type="float" value="40"/>
      <property name="boundary_bottom" type="float" value="8"/></properties></object>)";
  const Scene scene = files.load("map.tmx", tmx(objects("Moving Platforms", mover) + csv_layer(floor_csv) + spawn));
  ASSERT_EQ(scene.movers.size(), 1U);
  const MoverDef& def = scene.movers[0];
  ASSERT_EQ(scene.ids.front(), "m9");
  EXPECT_EQ(scene.scenery.colliders.front().mover, 0U);
  EXPECT_EQ(corners(scene.scenery.colliders.front()), box_corners(3, -2, 4, -1));
  // The map is 48 px high: the platform begins with its lower edge at 16 px; up to 40 its upper edge has 8 px to go,
  // down to 8 its lower edge 8 px. 2 px per 1/60 s.
  ASSERT_EQ(def.path.size(), 4U);
  EXPECT_EQ(def.path[1].at, Vec2d(0, 8 / 16.0));
  EXPECT_EQ(def.path[2].at, Vec2d(0, -8 / 16.0));
  EXPECT_EQ(def.path[3].at, Vec2d(0, 0));
  EXPECT_EQ(def.path[1].time, 8 / 120.0);
  EXPECT_NEAR(def.path[3].time, 32 / 120.0, 1e-15);
  EXPECT_EQ(def.loop, MoverDef::Loop::loop);
}

TEST(TiledStart, a_spawn_inside_a_solid_is_refused_with_its_line) {
  const SceneFiles files;
  const std::string message =
      files.complaint("map.tmx", tmx(csv_layer(floor_csv) + "\n" + with(spawn, "y=\"4\"", "y=\"24\"")));
  EXPECT_TRUE(begins(message, ":5: expected a start outside of every solid"));
}

TEST(TiledStart, at_a_point_the_sprite_stands) {
  const SceneFiles files;
  const auto start = [&](const std::string& at) {
    return files
        .load("map.tmx", tmx(csv_layer(floor_csv) +
                             objects("things", "<object id=\"1\" name=\"Spawn\" " + at + "><point/></object>")))
        .start.position;
  };
  // The middle of the lower edge; the sprite is 40 px at 32 px/m high, and its centre is half of that above.
  EXPECT_EQ(start("x=\"24\" y=\"20\""), Vec2d(24 / 16.0, -20 / 16.0 + 20 / 32.0));
  EXPECT_EQ(start("x=\"24\" y=\"32\""), Vec2d(24 / 16.0, -2 + 20 / 32.0)) << "on the ground";
  EXPECT_TRUE(
      begins(files.complaint("map.tmx",
                             tmx(csv_layer(floor_csv) + "\n" +
                                 objects("things", R"(<object id="1" name="Spawn" x="24" y="33"><point/></object>)"))),
             ":5: expected a start outside of every solid"));
}

TEST(TiledStart, who_stands_on_the_ground_by_a_point_is_not_inside_by_a_rounding) {
  const SceneFiles files;
  // Grounds whose height in metres no double is, above the origin: where the sprite's middle is in a higher binade the
  // sum is rounded.
  int rounded_up = 0;
  for (int k = 1; k < 200; ++k) {
    const std::string y = std::to_string(-k);
    const Scene scene = files.load(
        "map.tmx", R"(<map orientation="orthogonal" width="20" height="20" tilewidth="18" tileheight="18">)" +
                       objects("solid", "<object id=\"2\" x=\"0\" y=\"" + y + "\" width=\"90\" height=\"9\"/>") +
                       objects("spawn", "<object id=\"1\" x=\"45\" y=\"" + y + "\"><point/></object>") + "</map>");
    // It was loaded, so that by exact arithmetic it overlaps nothing.
    const double rounded = k / 18.0 + 0.625;
    const double place = scene.start.position.y();
    EXPECT_TRUE(place == rounded || place == std::nextafter(rounded, 100.0)) << k;
    rounded_up += place != rounded;
  }
  EXPECT_GT(rounded_up, 5) << "the rounding that this is about did not happen";
}

/// How far to the right a walker of a map gets in 2 s [m].
double walked_in(const Scene& scene) {
  const Scenery<double> scenery(scene.scenery);
  const Controller<double> controller(scenery, scene.character);
  Scratch<double> scratch = controller.make_scratch();
  StepReport<double> report;
  CharacterState<double> state;
  state.position = scene.start.position;
  for (int step = 0; step < 120; ++step)
    controller.step(state, {.move = 1.0}, {scene.gravity, scene.dt}, scratch, report);
  return state.position.x() - scene.start.position.x();
}

TEST(TiledStart, a_kerb_of_a_pixel_stops_no_walker_and_a_higher_one_does) {
  const SceneFiles files;
  // 32 px/m: 6 mm are 0.2 px. The kerb is 3 m ahead, and 2 s at 6 m/s go further.
  const auto with_kerb = [&](double pixels) {
    const std::string top = std::to_string(160 - pixels);
    return files.load(
        "map.tmx",
        R"(<map orientation="orthogonal" width="40" height="10" tilewidth="32" tileheight="32">)" +
            objects("solid", R"(<object id="1" x="0" y="160" width="160" height="64"/><object id="2" x="160" y=")" +
                                 top + R"(" width="900" height="64"/>)") +
            objects("spawn", R"(<object id="3" x="64" y="160"><point/></object>)") + "</map>");
  };
  const double free = walked_in(with_kerb(0));
  EXPECT_GT(free, 10);
  for (const double pixels : {0.2, 0.5, 0.9, 1.0}) EXPECT_NEAR(walked_in(with_kerb(pixels)), free, 1e-6) << pixels;
  // The nearest point of the outline, the foot or the arm, is 10 px ahead of the middle.
  for (const double pixels : {1.1, 4.0}) EXPECT_NEAR(walked_in(with_kerb(pixels)), 3, 10 / 32.0) << pixels;
  Scene without = with_kerb(0.2);
  without.character.step_height = 0;
  EXPECT_NEAR(walked_in(without), 3, 10 / 32.0) << "what this is about";
}

TEST(TiledStart, the_character_of_a_map_climbs_a_pixel_and_that_of_a_scene_what_the_scene_says) {
  const SceneFiles files;
  const std::string map = tmx(csv_layer(floor_csv) + spawn);
  const Scene alone = files.load("map.tmx", map);
  EXPECT_EQ(alone.character.step_height, 1 / 16.0);
  EXPECT_EQ(alone.description, "its character climbs kerbs up to a pixel of the map (0.0625 m)");
  const Scene within = files.load("scene.json", R"({"paperproof_scene": 1, "name": "n", "gravity": [0, 0], "dt": 1,
      "steps": 1, "character": {"position": [1, 0]}, "scenery": [{"id": "m", "tiled": "map.tmx"}]})");
  EXPECT_EQ(within.character.step_height, 0);
  EXPECT_EQ(within.description, "");
}

TEST(TiledStart, without_a_spawn_it_is_above_the_first_ground_with_room) {
  const SceneFiles files;
  // Column 0 is solid to the top: there is no room within the map. Column 1 has ground in row 2.
  const Scene scene = files.load("map.tmx", tmx(csv_layer("1,0,0,0, 1,0,0,0, 1,1,1,1")));
  EXPECT_EQ(scene.start.position, Vec2d(1.5, -2 + 1 / 16.0 + 20 / 32.0));
  EXPECT_TRUE(
      begins(files.complaint("map.tmx", tmx(csv_layer("1,1,1,1, 1,1,1,1, 1,1,1,1"))), ": expected a spawn object"));
}

TEST(TiledStart, a_layer_may_mark_it_too) {
  const SceneFiles files;
  const std::string layer = objects("Player", R"(<object id="3" x="20" y="2"/><object id="4" x="40" y="2"/>)");
  EXPECT_EQ(files.load("map.tmx", tmx(csv_layer(floor_csv) + layer)).start.position,
            Vec2d(20 / 16.0 + 10 / 32.0, -2 / 16.0 - 20 / 32.0));
}

TEST(TiledFiles, external_tilesets_in_both_formats_are_found_relative_to_the_map_or_beside_it) {
  const SceneFiles files;
  const std::string shapes =
      R"(<tile id="0"><objectgroup><object id="1" x="0" y="8" width="16" height="8"/></objectgroup></tile>)";
  files.write("sets/a.tsx",
              "<tileset name=\"a\" tilewidth=\"16\" tileheight=\"16\" tilecount=\"4\">" + shapes + "</tileset>");
  files.write("b.json", R"({"type": "tileset", "name": "b", "tilewidth": 16, "tileheight": 16, "tilecount": 4,
      "tiles": [{"id": 1, "objectgroup": {"objects": [{"id": 1, "x": 0, "y": 12, "width": 16, "height": 4}]}}]})");
  std::string map = tmx(csv_layer("0,0,0,0, 0,0,0,0, 1,11,16,16") + spawn);
  map = with(map, "<layer",
             "<tileset firstgid=\"11\" source=\"sets/a.tsx\"/><tileset firstgid=\"15\" "
             "source=\"../elsewhere/b.json\"/><layer");
  const Scene scene = files.load("map.tmx", map);
  EXPECT_EQ(corners(collider(scene, "t0,2")), box_corners(0, -3, 1, -2));
  EXPECT_EQ(corners(collider(scene, "t1,2")), box_corners(1, -3, 2, -2.5));
  EXPECT_EQ(corners(collider(scene, "t2,2")), box_corners(2, -3, 3, -2.75));
}

TEST(TiledFiles, json_maps_mean_the_same) {
  const SceneFiles files;
  const std::string text = R"({"type": "map", "orientation": "orthogonal", "width": 4, "height": 3, "tilewidth": 16,
    "tileheight": 16, "infinite": false,
    "tilesets": [{"firstgid": 1, "name": "a", "tilewidth": 16, "tileheight": 16, "tilecount": 4,
                  "tiles": {"1": {"objectgroup": {"objects": [{"id": 1, "x": 0, "y": 8, "width": 16, "height": 8}]}}}}],
    "layers": [{"type": "group", "name": "g", "offsetx": 16, "offsety": 0, "layers": [
                 {"type": "tilelayer", "name": "platforms", "width": 4, "height": 3, "data": [0,0,0,0, 0,0,0,0, 1,2,1,0]}]},
               {"type": "imagelayer", "name": "sky"},
               {"type": "objectgroup", "name": "collision", "objects": [
                 {"id": 3, "type": "platform", "properties": {"platform": "true"}, "x": 0, "y": 16,
                  "polyline": [{"x": 0, "y": 0}, {"x": 16, "y": 0}]},
                 {"id": 4, "properties": [{"name": "solid", "type": "bool", "value": false}], "x": 0, "y": 0, "width": 4, "height": 4}]},
               {"type": "objectgroup", "name": "p", "objects": [{"id": 5, "name": "player", "x": 24, "y": 2}]}]})";
  for (const char* name : {"map.json", "map.tmj"}) {
    const Scene scene = files.load(name, text);
    EXPECT_EQ(scene.ids, (std::vector<std::string>{"t0,2", "t1,2", "t2,2", "o3"}));
    EXPECT_EQ(corners(collider(scene, "t1,2")), box_corners(2, -3, 3, -2.5));
    EXPECT_EQ(collider(scene, "o3").one_way, Vec2d(0, 1));
  }
  EXPECT_TRUE(begins(files.complaint("map.json", with(text, "[0,0,0,0, 0,0,0,0, 1,2,1,0]", "[1,2]")),
                     ": /layers/0/layers/0/data: expected 12 tiles, found 2"));
  EXPECT_TRUE(begins(files.complaint("map.json", with(text, "1,2,1,0]", "1,2,1,-1]")),
                     ": /layers/0/layers/0/data: expected a tile number as entry 11"));
  EXPECT_TRUE(begins(files.complaint("map.json", with(text, "1,2,1,0]", "1,99,1,0]")),
                     ": /layers/0/layers/0: expected a tile of one of the tilesets; 99 belongs to none"));
  EXPECT_TRUE(begins(files.complaint("map.json", with(text, "\"x\": 24", "\"x\": \"24\"")),
                     ": /layers/3/objects/0/x: expected a number"));
}

TEST(TiledFiles, a_scene_that_names_a_map_reports_trouble_at_that_place) {
  const SceneFiles files;
  files.write("map.tmx", tmx(objects("collision", "\n<object id=\"3\" x=\"a\" y=\"0\"/>")));
  EXPECT_TRUE(begins(
      files.complaint("scene.json", R"({"paperproof_scene": 1, "name": "n", "gravity": [0, 0], "dt": 1, "steps": 1,
      "character": {"position": [0, 0]}, "scenery": [{"id": "m", "tiled": "map.tmx"}]})"),
      ": /scenery/0/tiled: map.tmx:5: expected a finite number in \"x\", not \"a\""));
}

TEST(TiledFiles, bad_maps_are_refused_with_their_line) {
  const SceneFiles files;
  const auto complaint = [&](const std::string& text) { return files.complaint("map.tmx", text); };
  const std::string map = tmx(csv_layer(floor_csv) + spawn);
  const auto base64_map = [&](const std::string& compression, const std::string& text) {
    return tmx(
        tile_layer("Collision", "<data encoding=\"base64\" compression=\"" + compression + "\">" + text + "</data>"));
  };
  const std::string bytes = little_endian(std::vector<TileNumber>(12, 1));
  std::string corrupt = deflated(bytes, 15);
  corrupt[3] = static_cast<char>(corrupt[3] ^ 0x55);

  EXPECT_TRUE(begins(complaint(""), ":1: expected XML; the file is empty"));
  EXPECT_TRUE(begins(complaint(with(map, "</map>", "")), ":5: expected XML; "));
  EXPECT_TRUE(begins(complaint("<?xml version=\"1.0\"?>\n<html/>"), ":2: expected <map> as the outermost element"));
  EXPECT_TRUE(begins(complaint(with(map, "\"orthogonal\"", "\"isometric\"")), ":2: expected an orthogonal map"));
  EXPECT_TRUE(begins(complaint(with(map, " width=\"4\" height=\"3\"", " width=\"0\" height=\"3\"")),
                     ":2: expected a map of at least one"));
  EXPECT_TRUE(begins(complaint(with(map, "0,0,0,0,", "0,0,0,")), ":4: expected 12 tiles, found 11"));
  EXPECT_TRUE(begins(complaint(with(map, "1,1,1,1", "1,x,1,1")), ":4: expected a tile number as entry 9"));
  EXPECT_TRUE(begins(complaint(with(map, "1,1,1,1", "1,1,1,11")),
                     ":4: expected a tile of one of the tilesets; 11 belongs to none"));
  EXPECT_TRUE(begins(complaint(with(map, "encoding=\"csv\"", "encoding=\"hex\"")),
                     ":4: expected the encoding csv, base64 or none"));
  EXPECT_TRUE(begins(complaint(with(map, "<layer", "<tileset firstgid=\"11\" source=\"none.tsx\"/><layer")),
                     ":4: tileset none.tsx: expected a file that exists"));
  EXPECT_TRUE(begins(complaint(base64_map("", base64(bytes).substr(0, 30))), ":4: expected base64; it is cut off"));
  EXPECT_TRUE(begins(complaint(base64_map("", "AA*A")), ":4: expected base64; \"*\" does not belong there"));
  EXPECT_TRUE(
      begins(complaint(base64_map("", base64(bytes.substr(4)))), ":4: expected 48 bytes for 12 tiles, found 44"));
  EXPECT_TRUE(begins(complaint(base64_map("zlib", base64(corrupt))), ":4: expected zlib or gzip data; it is corrupt"));
  EXPECT_TRUE(begins(complaint(base64_map("zlib", base64(deflated(bytes, 15).substr(0, 8)))),
                     ":4: expected zlib or gzip data; "));
  EXPECT_TRUE(begins(complaint(base64_map("zlib", base64(deflated(bytes + bytes, 15)))),
                     ":4: expected 48 bytes for 12 tiles, found more"));
  EXPECT_TRUE(begins(complaint(base64_map("gzip", base64(zstd(bytes)))), ":4: expected zlib or gzip data"));
  EXPECT_TRUE(begins(complaint(base64_map("zstd", base64(zstd(bytes).substr(0, 9)))), ":4: expected zstd data"));
  EXPECT_TRUE(
      begins(complaint(base64_map("lzma", base64(bytes))), ":4: expected the compression zlib, gzip, zstd or none"));
  EXPECT_TRUE(begins(complaint(tmx(spawn)), ": expected at least one solid"));
  EXPECT_TRUE(
      begins(complaint(tmx(objects(
                 "collision", "\n<object id=\"3\" x=\"0\" y=\"0\"><polygon points=\"0,0 8,8 8,0 0,8\"/></object>"))),
             ":5: \"o3\": "));
  EXPECT_TRUE(
      begins(complaint(tmx(objects("collision", "<object id=\"3\" x=\"nan\" y=\"0\" width=\"4\" height=\"4\"/>"))),
             ":4: expected a finite number in \"x\""));
  EXPECT_TRUE(begins(
      complaint(tmx(objects("collision", "<object id=\"3\" x=\"0\" y=\"0\"><polygon points=\"0 8,8 8,0\"/></object>"))),
      ":4: expected points as"));
  EXPECT_TRUE(begins(complaint(tmx(objects("collision", "<object id=\"3\" template=\"a.tx\" x=\"0\" y=\"0\"/>"))),
                     ":4: expected a solid with its own shape"));
  std::string deep = csv_layer(floor_csv);
  for (int i = 0; i < 1000; ++i) deep = "<group>" + deep + "</group>";
  EXPECT_TRUE(holds(complaint(tmx(deep)), "expected fewer groups within groups"));
}

struct Published {
  const char* file;
  std::size_t polygons;
  std::size_t chains;
  std::size_t one_way;
};

std::filesystem::path levels() { return std::filesystem::path(PAPERPROOF_SOURCE_DIR) / ".." / "shared" / "levels"; }

TEST(TiledFamilies, each_has_the_solids_that_an_independent_reader_counted) {
  if (!std::filesystem::exists(levels())) GTEST_SKIP() << "../shared/levels is missing";
  for (const Published& map :
       {Published{"sticker-knight/sandbox.tmx", 16 + 2, 0, 0}, Published{"sticker-knight/sandbox2.tmx", 28 + 4, 0, 0},
        Published{"melonjs/map1.tmx", 10 + 1, 2, 6}, Published{"melonjs/map2.json", 4, 2, 7},
        Published{"haxeflixel/test2.tmx", 12, 0, 0}}) {
    const Scene scene = load_scenes((levels() / map.file).string()).front();
    const auto count = [&](bool polygon, bool one_way) {
      return static_cast<std::size_t>(
          std::count_if(scene.scenery.colliders.begin(), scene.scenery.colliders.end(), [&](const ColliderDef& c) {
            return (c.shape == ColliderDef::Shape::polygon) == polygon && c.one_way.has_value() == one_way;
          }));
    };
    EXPECT_EQ(count(true, false), map.polygons) << map.file;
    EXPECT_EQ(count(false, false), map.chains) << map.file;
    EXPECT_EQ(count(false, true), map.one_way) << map.file;
  }
}

TEST(TiledFamilies, the_arcade_maps_load_and_the_larger_ones_have_47_to_127_platform_tiles) {
  if (!std::filesystem::exists(levels())) GTEST_SKIP() << "../shared/levels is missing";
  std::vector<std::size_t> sizes;
  std::size_t movers = 0;
  for (const char* name :
       {"map", "map2_level_1", "map2_level_2", "map_with_ladders", "pymunk_test_map", "test_map_3", "test_map_7"}) {
    const Scene scene = load_scenes((levels() / "arcade" / (std::string(name) + ".json")).string()).front();
    // A tile may have several shapes; those behind the first one have an id with a dot.
    std::size_t tiles = 0;
    for (std::size_t i = 0; i < scene.ids.size(); ++i) {
      const bool stands = scene.scenery.colliders[i].mover == no_mover;
      if (stands && scene.ids[i].find('.') == std::string::npos) ++tiles;
    }
    sizes.push_back(tiles);
    movers += scene.movers.size();
  }
  std::sort(sizes.begin(), sizes.end());
  EXPECT_EQ(sizes.size(), 7U);
  EXPECT_EQ(sizes[1], 47U);
  EXPECT_EQ(sizes.back(), 127U);
  EXPECT_EQ(movers, 2U);  // of three moving platforms one has no turning points
}

std::size_t flipped(const std::vector<TiledLayer>& layers) {
  std::size_t count = 0;
  for (const TiledLayer& layer : layers) {
    count += flipped(layer.layers);
    for (const TiledChunk& chunk : layer.chunks) {
      for (const TileNumber tile : chunk.tiles) {
        if ((tile & (flipped_horizontally | flipped_vertically | flipped_diagonally)) != 0) ++count;
      }
    }
  }
  return count;
}

TEST(TiledFamilies, flipped_tiles_are_counted_as_published) {
  if (!std::filesystem::exists(levels())) GTEST_SKIP() << "../shared/levels is missing";
  const std::string path = (levels() / "haxeflixel" / "test2.tmx").string();
  EXPECT_EQ(flipped(read_tmx_map(path, path).layers), 37U);
}

}  // namespace
}  // namespace paperproof::compare
