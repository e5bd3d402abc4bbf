// Names of types in the comments of the page's modules, which tell where each is made.

type Action = import("../../assoc_hull/page/static/actions.js").Action;
type Curve = import("../../assoc_hull/page/static/wire.js").Curve;
type Frame = import("../../assoc_hull/page/static/wire.js").Frame;
type Hand = import("../../assoc_hull/page/static/hand.js").Hand;
type Held = import("../../assoc_hull/page/static/store.js").Held;
type Kind = import("../../assoc_hull/page/static/view.js").Kind;
type Line = import("../../assoc_hull/page/static/net.js").Line;
type Name = import("../../assoc_hull/page/static/view.js").Name;
type Net = import("../../assoc_hull/page/static/net.js").Net;
type Page = import("../../assoc_hull/page/static/page.js").Page;
type Particulars = import("../../assoc_hull/page/static/net.js").Particulars;
type Point = import("../../assoc_hull/page/static/net.js").Point;
type Refusal = import("../../assoc_hull/page/static/store.js").Refusal;
type Shaper = import("../../assoc_hull/page/static/propose.js").Shaper;
type Stale = import("../../assoc_hull/page/static/store.js").Stale;
type Store = import("../../assoc_hull/page/static/store.js").Store;
type View = import("../../assoc_hull/page/static/view.js").View;
