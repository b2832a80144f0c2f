use groundspring::*;
use groundspring::spring::*;
use std::time::Instant;
fn main(){
    let text=std::fs::read_to_string("tuning/records/IELC180.AT2").unwrap();
    let accel:Vec<f64>=text.lines().skip(4).flat_map(|l|l.split_whitespace()).map(|x|x.parse::<f64>().unwrap()*9.81).collect();
    let s=structure::Structure::paper();
    let mut body=s.body::<f64>();
    let arg:Vec<f64>=std::env::args().skip(1).map(|x|x.parse().unwrap()).collect();
    let icg=arg.get(0).copied().unwrap_or(0.0);
    let hz=arg.get(1).copied().unwrap_or(160.0);
    let tol=arg.get(2).copied().unwrap_or(1e-9);
    let (mu,k,c)=(arg.get(3).copied().unwrap_or(10.0),arg.get(4).copied().unwrap_or(9.2),arg.get(5).copied().unwrap_or(4.4));
    body.inertia=icg*body.mass*body.radius().powi(2);
    let d=Design::from_kc(mu,k,c,hz);
    let springs=Springs{vertical:d,horizontal:d}.chains(body.mass);
    let sim=|tol:f64|{
        let mut r=fem::Recorder::default();
        let t=Instant::now();
        let o=fem::simulate(&body,&springs,0.01,&accel,1.0,2001,fem::Control{tolerance:tol,..Default::default()},&mut r);
        (r,o,t.elapsed())
    };
    let (r,o,_)=sim(tol);
    let (r0,o0,_)=sim(1e-11);
    let mut best=f64::INFINITY;
    for _ in 0..10{let t=sim(tol).2.as_secs_f64();best=best.min(t);}
    println!("{:?} {:?}\n time {:.3} ms, scale {:.3e} residual {:.2e} energy {:?}",o.0,o.1,best*1e3,o.2,r.worst/o.2,o.3);
    println!(" fine {:?} residual {:.2e}, difference u {:.2e} v {:.2e}",o0.1,r0.worst/o0.2,motion::nrmse(&r.motion.u,&r0.motion.u),motion::nrmse(&r.motion.v,&r0.motion.v));
    println!(" peaks {:.4} {:.4} mm v {:.3}", r.motion.u.iter().cloned().fold(0.,f64::max)*1e3, r.motion.u.iter().cloned().fold(0.,f64::min)*1e3, r.motion.v.iter().cloned().fold(0.,f64::max)*1e3);
    println!(" events {}", r.events.len());
}
