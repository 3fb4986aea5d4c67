# Godot 3's KinematicBody2D, driven as its documentation says; godot.py starts it and passes the lines on.
#
# Sources: docs.godotengine.org/en/3.2, "Using KinematicBody2D", "Kinematic character (2D)", and the classes KinematicBody2D
# (move_and_slide, move_and_slide_with_snap), CollisionShape2D (one_way_collision) and CollisionPolygon2D; for `snap` the
# demo 2d/platformer. Its lengths are pixels, y is down: a metre is 32 of them, the scenes' own scale.
extends SceneTree

const SCALE = 32.0
const UP = Vector2(0, -1)
# So far below its feet the demo looks for ground [px].
const SNAP = 20.0
enum {ABOVE, ACROSS, BELOW, BESIDE}

var link = StreamPeerTCP.new()
var snaps = false
var most_steep = 0.0
var bodies = {}  # by the id of their collider
var gates = []  # the segments of what is one-way
var on_platform = false  # what moves is stood on
var hull = []
var character = KinematicBody2D.new()


func _init():
	snaps = "snap" in OS.get_cmdline_args()
	link.connect_to_host("127.0.0.1", int(OS.get_environment("PAPERPROOF_PORT")))
	while link.get_status() == StreamPeerTCP.STATUS_CONNECTING:
		pass
	link.set_no_delay(true)
	yield(self, "physics_frame")
	var run = hear()["run"]
	for collider in run["colliders"]:
		if collider.has("holes") or collider.has("polygon") and collider.has("one_way"):
			link.put_utf8_string('{"refuses":"a polygon with a hole, or a one-way one"}')
			return
	build(run)
	var called = "Godot KinematicBody2D" + (" with snap" if snaps else "")
	var greeting = {"name": called, "version": Engine.get_version_info()["string"], "scalar": "float"}
	greeting["machine"] = "script"
	greeting["overlap"] = true
	greeting["skin"] = character.get_safe_margin() / SCALE
	greeting["can"] = ["movers", "turning", "one_way", "circles", "conveyors"]
	link.put_utf8_string(to_json(greeting))
	while true:
		var step = hear()
		yield(drive(step.get("movers", {})), "completed")
		if step.has("overlap"):
			link.put_utf8_string(to_json({"overlaps": overlaps(step["overlap"])}))
			continue
		link.put_utf8_string(answer(step["characters"][0], step["dt"]))


func hear():
	return JSON.parse(link.get_utf8_string()).result


func pixels(point):
	return Vector2(point[0] * SCALE, -point[1] * SCALE)


# As JSON. `to_json` would round to six places.
func metres(v):
	return "%.9f,%.9f" % [v.x / SCALE, -v.y / SCALE]


func pixels_of(points):
	var result = PoolVector2Array()
	for point in points:
		result.append(pixels(point))
	return result


func build(run):
	# A step of the scene is a frame of the physics.
	Engine.iterations_per_second = int(max(1, round(1 / run["dt"])))
	most_steep = deg2rad(run["max_climb_degrees"])
	var moving = []
	for mover in run.get("movers", []):
		moving += mover["colliders"]
	for collider in run["colliders"]:
		if not collider.get("sensor", false):
			add(collider, KinematicBody2D.new() if collider["id"] in moving else StaticBody2D.new())
	hull = pixels_of(run["points"])
	character.add_child(shape_node(ConvexPolygonShape2D.new()))
	character.get_child(0).shape.points = hull
	root.add_child(character)


func add(collider, body):
	body.set_meta("id", collider["id"])
	bodies[collider["id"]] = body
	root.add_child(body)
	if collider.has("circle"):
		var disc = shape_node(CircleShape2D.new())
		disc.shape.radius = collider["circle"][2] * SCALE
		disc.position = pixels(collider["circle"])
		body.add_child(disc)
	elif collider.has("polygon"):
		var node = CollisionPolygon2D.new()
		node.polygon = pixels_of(collider["polygon"])
		body.add_child(node)
	else:
		var chain = pixels_of(collider["chain"])
		for i in range(1, chain.size()):
			var node = shape_node(SegmentShape2D.new())
			if collider.has("one_way"):
				# Godot's block what comes from their own top: they are turned until that is where the normal is.
				node.rotation = UP.angle_to(pixels(collider["one_way"]))
				node.one_way_collision = true
				gates.append(node)
			node.shape.a = chain[i - 1].rotated(-node.rotation)
			node.shape.b = chain[i].rotated(-node.rotation)
			body.add_child(node)


func shape_node(shape):
	var node = CollisionShape2D.new()
	node.shape = shape
	return node


# Of the character beside a one-way segment: above it, across its line, or below; or past its ends.
func side_of(gate):
	var a = gate.shape.a
	var along = gate.shape.b - a
	var beneath = []
	var right = []
	for point in hull:
		var at = gate.global_transform.xform_inv(character.position + point) - a
		beneath.append(along.cross(at) * sign(along.x))
		right.append(at.x * sign(along.x))
	if right.max() < 0 or right.min() > abs(along.x):
		return BESIDE
	return ABOVE if beneath.max() <= 0 else BELOW if beneath.min() >= 0 else ACROSS


# Movers are set, and the next frame of the physics takes them there, with a velocity of their own.
func drive(movers):
	for id in movers:
		if bodies[id].position.distance_to(pixels(movers[id]["from"])) > 0.01:
			bodies[id].position = pixels(movers[id]["from"])
			yield(self, "physics_frame")
	for id in movers:
		bodies[id].position = pixels(movers[id]["to"])
		bodies[id].rotation = -movers[id].get("angle", [0, 0])[1]
	yield(self, "physics_frame")


# What intersect_shape has there, without the safe margin.
func overlaps(place):
	var query = Physics2DShapeQueryParameters.new()
	query.set_shape(character.get_child(0).shape)
	query.transform = Transform2D(0, pixels(place))
	query.exclude = [character]
	var found = []
	for hit in root.find_world_2d().direct_space_state.intersect_shape(query):
		if not hit.collider.get_meta("id") in found:
			found.append(hit.collider.get_meta("id"))
	return found


func answer(asked, dt):
	if asked.has("put"):
		character.position = pixels(asked["put"]["position"])
	var drops = asked.get("drop", false)
	var held_by = []
	for gate in gates:
		# Who drops is held by none, nor as long as it is across one then.
		gate.disabled = drops or (gate.disabled and side_of(gate) == ACROSS)
		if drops and side_of(gate) == ABOVE:
			held_by.append(gate)
	var frames = dt * Engine.iterations_per_second  # of the physics in this step: 1 but for rounding
	var wanted = pixels(asked["wanted"]) * frames
	var stays = not on_platform  # on a slope; the demo does not ask for it on what moves
	var snap = SNAP * -UP if snaps and wanted.y >= 0 else Vector2()  # none: as move_and_slide
	var began = OS.get_ticks_usec()
	var left = character.move_and_slide_with_snap(wanted, snap, UP, stays, 4, most_steep)
	var took = OS.get_ticks_usec() - began
	var contacts = PoolStringArray()
	var through = []
	var ground = ""
	on_platform = false
	for i in character.get_slide_count():
		var hit = character.get_slide_collision(i)
		var id = hit.collider.get_meta("id")
		var touch = '"collider":"%s","normal":[%.9f,%.9f]' % [id, hit.normal.x, -hit.normal.y]
		contacts.append('{%s,"point":[%s]}' % [touch, metres(hit.position)])
		if acos(hit.normal.dot(UP)) > most_steep + 0.01:
			continue
		# What moves takes along who stands on it, by itself: such ground is not named.
		on_platform = hit.collider is KinematicBody2D
		ground = "" if on_platform else ',"ground":{%s}' % touch
	for gate in held_by:
		var id = gate.get_parent().get_meta("id")
		if side_of(gate) in [ACROSS, BELOW] and not id in through:
			through.append(id)
	var said = '"path":[[%s,1]],"velocity":[%s]' % [metres(character.position), metres(left / frames)]
	said += ',"grounded":%s%s,"contacts":[%s]' % [to_json(character.is_on_floor()), ground, contacts.join(",")]
	return '{"characters":[{%s,"dropped_through":%s}],"ns":%d}' % [said, to_json(through), took * 1000]
