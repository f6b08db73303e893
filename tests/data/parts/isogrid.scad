// A square panel of an isogrid: skin 1.2 mm, ribs 1.6 x 10 mm along three directions 60 degrees apart. mm.
module ribs(a) rotate(a) for (k = [-1:1]) translate([-150, 34.6410 * k - 0.8, 0]) square([300, 1.6]);
intersection() {
  union() {
    linear_extrude(1.2) square(90, center = true);
    linear_extrude(11.2) { ribs(0); ribs(60); ribs(120); }
  }
  translate([-45, -45, -1]) cube([90, 90, 20]);
}
